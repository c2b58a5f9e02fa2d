// A number from text.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace quorum {

/// The number that a whole token spells, independent of the locale; nothing if it spells none or is out of T's range.
template <typename T>
std::optional<T> parse_number(std::string_view token) {
  T value{};
  const char* end = token.data() + token.size();
  const auto [parsed_end, code] = std::from_chars(token.data(), end, value);
  if (code != std::errc() || parsed_end != end) return std::nullopt;
  return value;
}

}  // namespace quorum
