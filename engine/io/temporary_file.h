#pragma once

#include <filesystem>
#include <utility>

namespace quorum {

/// An open file descriptor, or -1; closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

/// A new file ".quorum-PROCESS-COUNTER.tmp" in a folder, removed at the end of its scope unless it was renamed.
class TemporaryFile {
 public:
  /// On failure the descriptor is -1 and errno says why.
  explicit TemporaryFile(const std::filesystem::path& folder);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  [[nodiscard]] int descriptor() const { return descriptor_.get(); }
  [[nodiscard]] bool rename_to(const std::filesystem::path& path);

 private:
  struct LivePath* live_;
  std::filesystem::path path_;
  Descriptor descriptor_;
  bool renamed_ = false;
};

/// Removes the temporary files of this process. It is about to end: a thread that begins another file waits for that.
/// May be called from a signal handler.
void remove_temporary_files() noexcept;

/// Removes the temporary files that killed processes have left in a folder and below; those of other processes of this
/// program that run on this machine stay.
void sweep_temporary_files(const std::filesystem::path& folder);

}  // namespace quorum
