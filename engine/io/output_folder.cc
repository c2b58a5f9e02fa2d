#include "engine/io/output_folder.h"

#include <fmt/format.h>

#include <fstream>

#include "engine/core/check.h"
#include "engine/io/file.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = ".quorum-files";

/// Makes the folders of a name, none of which may be a link to elsewhere.
Expected<void> make_parents(const fs::path& folder, const fs::path& name) {
  fs::path path = folder;
  for (const fs::path& part : name.parent_path()) {
    path /= part;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(path, ignored)))
      return path_failure(path, "is a link, and what it leads to is not to be replaced; choose another output folder");
    if (!fs::is_directory(path, ignored)) QUORUM_TRY(make_folder(path));
  }
  return {};
}

}  // namespace

Expected<OutputFolder> OutputFolder::open(const fs::path& folder) {
  QUORUM_TRY(make_folder(folder));
  OutputFolder result(folder);
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(folder / kList, ignored);
  if (!fs::exists(status)) return result;
  if (!fs::is_regular_file(status)) return path_failure(folder / kList, "is no file; choose another output folder");
  QUORUM_ASSIGN(const auto text, read_file(folder / kList));
  LineReader lines(text);
  while (const auto line = lines.next_filled()) result.ours_.emplace(*line);
  return result;
}

Expected<void> OutputFolder::write(const fs::path& name, std::string_view bytes) {
  for (const fs::path& part : name) QUORUM_CHECK_EQ(part == ".." || part.has_root_path(), false);
  QUORUM_TRY(make_parents(folder_, name));
  const fs::path path = folder_ / name;
  if (!ours_.contains(name.string())) {
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(path, ignored);
    if (fs::exists(status)) {
      const auto found =
          fs::is_regular_file(status) ? read_file(path) : Expected<std::string>(failure(ErrorKind::kInput, ""));
      if (found && *found == bytes) return {};
      return path_failure(path, "is there already and was not written by quorum; choose another output folder");
    }
    std::ofstream list(folder_ / kList, std::ios::app);
    list << name.string() << '\n' << std::flush;
    if (!list) return path_failure(folder_ / kList, "cannot be written; check the disk and the path");
    ours_.insert(name.string());
  } else if (std::error_code ignored; fs::is_symlink(fs::symlink_status(path, ignored))) {
    return path_failure(path, "is a link, which we did not make; choose another output folder");
  }
  return write_file(path, bytes);
}

}  // namespace quorum
