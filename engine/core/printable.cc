#include "engine/core/printable.h"

#include <cstddef>

namespace quorum {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;  ///< 0 = no UTF-8
};

/// The character at the beginning of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || bytes > text.size()) return {};
  char32_t code = first & (0x7fU >> bytes);
  for (std::size_t at = 1; at < bytes; ++at) {
    if ((byte(at) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(at) & 0x3fU);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < kLeast[bytes] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
  return {code, bytes};
}

bool is_shown(char32_t code) {
  const bool is_control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool breaks_or_turns = code == 0x061c || code == 0x200e || code == 0x200f ||
                               (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return !is_control && !breaks_or_turns;
}

}  // namespace

std::string printable(std::string_view text, char substitute) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    if (character.bytes > 0 && is_shown(character.code))
      result += text.substr(0, character.bytes);
    else
      result += substitute;
    text.remove_prefix(character.bytes > 0 ? character.bytes : 1);
  }
  return result;
}

}  // namespace quorum
