#include "engine/io/scratch_folder.h"

#include <stdlib.h>

namespace quorum {

Expected<ScratchFolder> ScratchFolder::make() {
  std::error_code problem;
  std::string name = (std::filesystem::temp_directory_path(problem) / "quorum-XXXXXX").string();
  if (problem || ::mkdtemp(name.data()) == nullptr)
    return failure(ErrorKind::kInput, name + ": cannot make a temporary folder; set TMPDIR");
  return ScratchFolder(name);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace quorum
