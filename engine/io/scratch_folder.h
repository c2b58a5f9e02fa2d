// A folder for what is needed for a while.
#pragma once

#include <filesystem>

#include "engine/core/error.h"

namespace quorum {

/// A folder of its own in the system's temporary folder, removed at the end.
class ScratchFolder {
 public:
  /// Fails (kInput) if it can't be made.
  static Expected<ScratchFolder> make();
  ~ScratchFolder();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace quorum
