// A file without a name, for what does not fit into memory between two steps of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

/// Bytes on the disk of a folder. Nothing is left of them when the object or the process ends, however that happens.
/// Several threads may write and read at once.
class ScratchFile {
 public:
  /// No file: of no use until one is assigned.
  ScratchFile() = default;
  ScratchFile(ScratchFile&& other) noexcept;
  ScratchFile& operator=(ScratchFile&& other) noexcept;
  ~ScratchFile();

  /// Fails (kInput) if the folder can't be written to.
  static Expected<ScratchFile> create(const std::filesystem::path& folder);

  /// Fails (kInput) if the disk is full or broken.
  [[nodiscard]] Expected<void> write(std::uint64_t offset, std::string_view bytes) const;
  /// Fills bytes, all of which were written. Fails (kInput) if the disk is broken.
  [[nodiscard]] Expected<void> read(std::uint64_t offset, std::span<char> bytes) const;

 private:
  std::filesystem::path folder_;
  int file_ = -1;
};

}  // namespace quorum
