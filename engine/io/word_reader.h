// Texts whose words count, wherever their lines break.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/io/text.h"

namespace quorum {

/// Takes words one after the other. After the first failure all numbers are 0, and done() tells it with file and line.
class WordReader {
 public:
  /// path and text must outlive the reader.
  WordReader(const std::filesystem::path& path, std::string_view text) : path_(path), lines_(text) { advance(); }

  /// The next word as a number. name: for the message.
  template <typename T>
  T number(std::string_view name) {
    if (failed()) return T{};
    if (word_.empty()) {
      fail(fmt::format("{} is missing", name));
      return T{};
    }
    const auto value = parse_number<T>(word_);
    if (!value)
      fail(fmt::format("{} = {} is not a number in range", name, quote_token(word_)));
    else
      advance();
    return value.value_or(T{});
  }
  /// Fails unless the next word is this one.
  void expect(std::string_view word) {
    if (failed()) return;
    if (word_ != word) return fail(fmt::format("expected the word {}, found {}", word, quote_token(word_)));
    advance();
  }
  [[nodiscard]] bool at_end() const { return word_.empty(); }
  [[nodiscard]] bool failed() const { return !problem_.empty(); }
  /// Fails at the next word.
  void fail(std::string_view message) {
    if (!failed()) problem_ = failure_at_line(path_, lines_.number(), message).error().message;
  }
  [[nodiscard]] Expected<void> done() const {
    if (failed()) return failure(ErrorKind::kInput, problem_);
    return {};
  }

 private:
  void advance() {
    std::size_t begin = rest_.find_first_not_of(kTextSpace);
    while (begin == std::string_view::npos) {
      const auto line = lines_.next();
      word_ = {};
      if (!line) return;
      rest_ = *line;
      begin = rest_.find_first_not_of(kTextSpace);
    }
    const std::size_t end = std::min(rest_.find_first_of(kTextSpace, begin), rest_.size());
    word_ = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
  }

  const std::filesystem::path& path_;
  LineReader lines_;
  std::string_view rest_;  ///< of the line
  std::string_view word_;  ///< the next one; empty at the end
  std::string problem_;
};

}  // namespace quorum
