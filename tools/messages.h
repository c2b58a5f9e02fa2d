// What the program says: messages on standard error, which never end it, and results on standard output, which must
// arrive.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "engine/core/error.h"

namespace quorum {

/// The place of standard error at the beginning of the program, whatever a library makes of it meanwhile. From there on
/// nothing that is opened takes the numbers of standard input, output and error. Once.
void open_messages();

/// Writes text for people as it is. What can't be written is dropped. May be called from a signal handler.
void write_message(std::string_view text) noexcept;

/// A message of one line; what does not print is replaced in it.
void tell(std::string_view line);

/// Adds to standard output; whether it arrives says flush_results.
void write_result(std::string_view text) noexcept;

/// The same, formatted.
template <typename... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  write_result(fmt::format(format, std::forward<Values>(values)...));
}

/// Fails (kInput) if something of the results so far could not be written.
Expected<void> flush_results();

}  // namespace quorum
