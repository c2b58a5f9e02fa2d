// What the tests of files share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

/// Expects a failure of bad input, told on one line that has each of the parts in it.
template <typename T>
void expect_bad_input(const Expected<T>& result, std::initializer_list<std::string_view> parts) {
  ASSERT_FALSE(result.has_value()) << "no failure, expected one with " << *parts.begin();
  EXPECT_EQ(result.error().kind, ErrorKind::kInput);
  const std::string& message = result.error().message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string_view part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << "\n  " << message;
}

/// The text with one to four changes by chance: a byte replaced, inserted or removed, a digit replaced, the end cut
/// off, a piece doubled, a word replaced by an extreme number, or one to eight bytes by the extremes of binary ones.
inline std::string mutate(std::string text, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t limit) { return random() % limit; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size());
    switch (below(8)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, 1, "0123456789-+.e \n"[below(16)]);
        break;
      case 2:
        text.erase(at, 1 + below(3));
        break;
      case 3: {
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
        break;
      }
      case 4:
        text.resize(at);
        break;
      case 5: {
        constexpr const char* kExtremes[] = {"0",      "-1",    "nan",        "inf",        "1e308",
                                             "1e-320", "-1e40", "2147483648", "4294967295", "18446744073709551615"};
        const std::size_t begin = std::min(text.find_first_of(" \n,", at), text.size() - 1) + 1;
        const std::size_t end = std::min(text.find_first_of(" \n,", begin), text.size());
        text.replace(begin, end - begin, kExtremes[below(std::size(kExtremes))]);
        break;
      }
      case 6:
        for (std::size_t i = at, end = std::min(at + 1 + below(8), text.size()); i < end; ++i)
          text[i] = "\x00\x01\x7f\x80\xff"[below(5)];
        break;
      default:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
    }
  }
  return text;
}

}  // namespace quorum
