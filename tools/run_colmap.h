// The installed COLMAP as a helper: photographs to cameras.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/pipeline/progress.h"

namespace quorum {

/// Finds the cameras of the photographs in a folder: runs `colmap` feature_extractor, exhaustive_matcher, mapper and
/// image_undistorter on the CPU, one after the other, with their output in work/STEP.log. The result is work/dense, a
/// dense workspace without depth maps. A step that was done for the same photographs (names, sizes and times) and size
/// is not done again. max_image_size: of the undistorted photographs, pixels; 0 = theirs.
/// Fails (kInput) if colmap is not installed or fails, or there are fewer than three photographs, and (kStopped).
Expected<void> run_colmap(const std::filesystem::path& photos, const std::filesystem::path& work, int max_image_size,
                          Progress& progress);

}  // namespace quorum
