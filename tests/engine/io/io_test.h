// What the tests of files share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
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
/// off, or a piece doubled.
inline std::string mutate(std::string text, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t limit) { return random() % limit; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size());
    switch (below(6)) {
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
      default:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
    }
  }
  return text;
}

}  // namespace quorum
