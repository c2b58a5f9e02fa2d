// The cameras of a Middlebury scene: its par file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/error.h"

namespace quorum {

/// One line of a par file.
struct ParLine {
  int number = 0;     ///< of the line in the file, from 1
  std::string image;  ///< file name
  Camera camera;
};

/// Parses the text of a par file: a count, or a column header, or neither; then a line of 22 fields per view. K is
/// scaled to K(2,2) = 1. Blank lines are skipped. Empty if the text is. Fails (kInput), naming path and line, if a line
/// is malformed or no camera, or if there are not as many as the count says.
Expected<std::vector<ParLine>> parse_par_file(const std::filesystem::path& path, std::string_view text);

/// The text of a par file with a count, with 17 significant digits, so that each number reads back as it is.
std::string format_par_file(const std::vector<ParLine>& lines);

}  // namespace quorum
