// Whole files, written so that a final name never holds half a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace quorum {

/// True for a regular file; false also if that can't be told.
bool is_file(const std::filesystem::path& path);

/// Bytes of a regular file. Fails (kInput) if it is absent, unreadable or not a regular file, and (kMemory) if it does
/// not fit into memory.
Expected<std::string> read_file(const std::filesystem::path& path);

/// Writes bytes to a temporary name in the folder of path, syncs, and renames it to path, which may be a regular file
/// already. On failure (kInput: no such folder, no permission, full disk, path is a folder or a device) the temporary
/// file is removed and path is as it was. A process that is killed may leave ".quorum-*.tmp" behind.
Expected<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Files of one folder that belong together, written as write_file does, but synced all at once.
class FileGroup {
 public:
  FileGroup();
  FileGroup(const FileGroup&) = delete;
  FileGroup& operator=(const FileGroup&) = delete;
  ~FileGroup();

  /// Writes bytes to a temporary name. Fails as write_file does.
  [[nodiscard]] Expected<void> add(const std::filesystem::path& path, std::string_view bytes);
  /// Syncs, and gives the files their names in the order in which they came: where the last one is, all are. Files that
  /// were added and not finished are removed with the object.
  [[nodiscard]] Expected<void> finish();

 private:
  struct Member;
  std::vector<Member> members_;
};

/// Fails (kInput) as write_file would, now, as far as that can be seen beforehand.
Expected<void> check_writable(const std::filesystem::path& path);

/// Removes a regular file, if it is there, so that no power failure brings it back.
void remove_file(const std::filesystem::path& path);

/// Makes a folder and its parents; one that is there already stays. Fails (kInput) if that can't be done or if no file
/// can be created in it.
Expected<void> make_folder(const std::filesystem::path& path);

}  // namespace quorum
