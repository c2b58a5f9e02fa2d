// What the outside can cause (files, options, memory, devices), as a value that travels up and gains a clause per
// layer.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <utility>

namespace quorum {

/// Kinds of failure; the value is the exit code of the command line (README, "Exit codes").
enum class ErrorKind {
  kDevice = 1,     ///< a device failed while it worked
  kUsage = 2,      ///< the command line or an option is wrong
  kInput = 3,      ///< a file or folder is missing, malformed, or can't be written
  kNoDevice = 4,   ///< the wanted device or the Vulkan loader is not there
  kMemory = 5,     ///< the work does not fit the memory
  kStopped = 143,  ///< SIGTERM or SIGINT asked to stop
};

/// One failure. message is one line: the place, what is wrong, and the remedy.
struct Error {
  ErrorKind kind = ErrorKind::kInput;
  std::string message;

  /// The same failure with a clause in front: "reading cameras: temple_par.txt:3: expected 22 fields, found 21".
  [[nodiscard]] Error within(std::string_view clause) const { return {kind, std::string(clause) + ": " + message}; }
};

template <typename T>
using Expected = std::expected<T, Error>;

/// An Expected that holds a failure.
inline std::unexpected<Error> failure(ErrorKind kind, std::string message) {
  return std::unexpected(Error{kind, std::move(message)});
}

}  // namespace quorum

#define QUORUM_JOIN_(a, b) a##b
#define QUORUM_JOIN(a, b) QUORUM_JOIN_(a, b)
#define QUORUM_ASSIGN_(result, declaration, ...)       \
  auto result = (__VA_ARGS__);                         \
  if (!result) [[unlikely]]                            \
    return std::unexpected(std::move(result).error()); \
  declaration = *std::move(result)

/// Declares the value of an Expected, or returns its failure from the enclosing function:
///   QUORUM_ASSIGN(const auto text, read_file(path));
#define QUORUM_ASSIGN(declaration, ...) QUORUM_ASSIGN_(QUORUM_JOIN(expected_, __COUNTER__), declaration, __VA_ARGS__)

/// Returns the failure of an Expected, if it is one, from the enclosing function: QUORUM_TRY(write_file(path, text));
#define QUORUM_TRY(...)                                \
  do {                                                 \
    if (auto done = (__VA_ARGS__); !done) [[unlikely]] \
      return std::unexpected(std::move(done).error()); \
  } while (false)
