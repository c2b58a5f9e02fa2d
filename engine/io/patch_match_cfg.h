// The list of compared images in a dense workspace of COLMAP: stereo/patch-match.cfg.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Sets the neighbors of views from pairs of lines: an image, then __auto__, N (left to view selection), __all__, or
/// images with commas between. # begins a comment. Views that are not named keep what they have; so does the last one
/// if its second line is missing. Returns how many names stand there that are not in the scene, which are left out.
/// Fails (kInput) if the file can't be read.
Expected<int> read_patch_match_cfg(const std::filesystem::path& path, std::vector<View>& views);

}  // namespace quorum
