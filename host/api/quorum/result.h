// Failures as values.
#pragma once

#include <quorum/api.h>

#include <optional>
#include <string>
#include <utility>

namespace quorum::v0 {

/// Kinds of failure. The value is the exit code of the program `quorum` for it.
enum class ErrorKind {
  kDevice = 1,     ///< a device or the system failed
  kUsage = 2,      ///< an option or an argument is wrong
  kInput = 3,      ///< a file or an array is bad, or a file can't be written
  kNoDevice = 4,   ///< there is no such device
  kMemory = 5,     ///< out of memory or threads, or a budget that is too small
  kStopped = 143,  ///< RunSettings::should_stop asked to stop
};

struct Error {
  ErrorKind kind = ErrorKind::kInput;
  std::string message;  ///< one line: the place, what is wrong, and the remedy
};

/// Prints what a caller did wrong that no input can cause, and ends the process.
[[noreturn]] QUORUM_API void end_by_misuse(const std::string& what);

/// A value, or the failure to get it. To take the value of a failure ends the process with its message: ask first.
///   const auto scene = quorum::Scene::read("temple");
///   if (!scene) return tell(scene.error().message);
///   use(*scene);
template <typename Value>
class [[nodiscard]] Result {
 public:
  Result(Value value) : value_(std::move(value)) {}  // NOLINT: a value is a result
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: and so is a failure

  [[nodiscard]] bool has_value() const { return value_.has_value(); }
  explicit operator bool() const { return has_value(); }

  Value& operator*() & {
    require_value();
    return *value_;
  }
  const Value& operator*() const& {
    require_value();
    return *value_;
  }
  Value&& operator*() && {
    require_value();
    return *std::move(value_);
  }
  Value* operator->() { return &**this; }
  const Value* operator->() const { return &**this; }

  /// The failure; of a value it is empty.
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  void require_value() const {
    if (!value_) end_by_misuse("the value of a failure was taken: " + error_.message);
  }

  std::optional<Value> value_;
  Error error_;
};

/// The same where there is nothing to get.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : failed_(true), error_(std::move(error)) {}  // NOLINT: a failure is a result

  [[nodiscard]] bool has_value() const { return !failed_; }
  explicit operator bool() const { return has_value(); }

  /// The failure; where there is none it is empty.
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  bool failed_ = false;
  Error error_;
};

}  // namespace quorum::v0
