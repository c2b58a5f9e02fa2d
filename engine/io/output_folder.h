// A folder that may hold files of the user's, into which we write.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

/// Writes files below a folder, and never replaces one that is not ours. What is ours stands in its file .quorum-files,
/// a name a line, which is written before the file is, so that a run that was killed can be done again.
class OutputFolder {
 public:
  /// Makes the folder. Fails (kInput) if it can't be made or written to, or its list can't be read.
  static Expected<OutputFolder> open(const std::filesystem::path& folder);

  /// Writes a file under a name, which may have folders in it; they are made. A file that is there with the same bytes
  /// stays as it is. Fails (kInput) if another one is there that is not ours, or a link, or if a folder on the way is a
  /// link, or as write_file does.
  Expected<void> write(const std::filesystem::path& name, std::string_view bytes);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  explicit OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::set<std::string> ours_;
};

}  // namespace quorum
