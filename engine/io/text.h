// Lines, tokens and numbers of text files, and failures that name a line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parse_number.h"

namespace quorum {

/// What separates tokens within a line.
inline constexpr std::string_view kTextSpace = " \t\r\f\v";

/// Tokens of a line.
std::vector<std::string_view> split_tokens(std::string_view line);

/// Walks over the lines of a text; they end with LF or CRLF, the last one also with the text.
class LineReader {
 public:
  /// A byte order mark, as editors on Windows write it, is passed over.
  explicit LineReader(std::string_view text) : text_(text), position_(text.starts_with("\xef\xbb\xbf") ? 3 : 0) {}

  /// The next line without its end, or nothing after the last one.
  std::optional<std::string_view> next();
  /// The next line that holds more than spaces, or nothing.
  std::optional<std::string_view> next_filled();
  /// Number of the line that was last returned; the first is 1.
  [[nodiscard]] int number() const { return number_; }
  /// Position of the first byte after that line.
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  int number_ = 0;
};

/// A token in quotes for a message: cut after 40 characters, with question marks for what can't be printed.
std::string quote_token(std::string_view token);

/// True if a text can't be shown on one line, as no sane name of a file is: ASCII's control characters and U+0080 to
/// U+009F.
bool has_control_characters(std::string_view text);

/// Failure (kInput) "path: message".
std::unexpected<Error> path_failure(const std::filesystem::path& path, std::string_view message);

/// Failure (kInput) "path:line: message".
std::unexpected<Error> failure_at_line(const std::filesystem::path& path, int line, std::string_view message);

}  // namespace quorum
