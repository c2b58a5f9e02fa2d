#include "engine/io/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace quorum {

std::vector<std::string_view> split_tokens(std::string_view line) {
  std::vector<std::string_view> tokens;
  std::size_t begin = line.find_first_not_of(kTextSpace);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kTextSpace, begin), line.size());
    tokens.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kTextSpace, end);
  }
  return tokens;
}

std::optional<std::string_view> LineReader::next() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  position_ = std::min(end + 1, text_.size());
  ++number_;
  return line;
}

std::optional<std::string_view> LineReader::next_filled() {
  auto line = next();
  while (line && line->find_first_not_of(kTextSpace) == std::string_view::npos) line = next();
  return line;
}

std::string quote_token(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text(token.substr(0, kLongest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return '"' + text + (token.size() > kLongest ? "...\"" : "\"");
}

bool has_control_characters(std::string_view text) {
  unsigned char before = 0;
  for (const char each : text) {
    const auto c = static_cast<unsigned char>(each);
    if (c < ' ' || c == 0x7f || (before == 0xc2 && c < 0xa0)) return true;
    before = c;
  }
  return false;
}

std::unexpected<Error> path_failure(const std::filesystem::path& path, std::string_view message) {
  return failure(ErrorKind::kInput, fmt::format("{}: {}", path.string(), message));
}

std::unexpected<Error> failure_at_line(const std::filesystem::path& path, int line, std::string_view message) {
  return failure(ErrorKind::kInput, fmt::format("{}:{}: {}", path.string(), line, message));
}

}  // namespace quorum
