// Checks of what only this program itself can get wrong. A failed check prints both values with file and line, and
// stops.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace quorum {

template <typename A, typename B>
[[noreturn]] void fail_check(const char* file, int line, const char* text, const A& a, const B& b) {
  fmt::print(stderr, "{}:{}: check failed: {} ({} against {})\n", file, line, text, a, b);
  std::fflush(stderr);
  std::abort();
}

}  // namespace quorum

#define QUORUM_CHECK_OP(a, op, b)                                                    \
  do {                                                                               \
    const auto& check_a = (a);                                                       \
    const auto& check_b = (b);                                                       \
    if (!(check_a op check_b)) [[unlikely]]                                          \
      ::quorum::fail_check(__FILE__, __LINE__, #a " " #op " " #b, check_a, check_b); \
  } while (false)

#define QUORUM_CHECK_EQ(a, b) QUORUM_CHECK_OP(a, ==, b)
#define QUORUM_CHECK_LE(a, b) QUORUM_CHECK_OP(a, <=, b)
#define QUORUM_CHECK_LT(a, b) QUORUM_CHECK_OP(a, <, b)
#define QUORUM_CHECK_GE(a, b) QUORUM_CHECK_OP(a, >=, b)
