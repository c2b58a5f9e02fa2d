// The installed COLMAP as a helper: photographs to cameras.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/pipeline/progress.h"

namespace quorum {

/// Finds the cameras of the photographs in a folder: runs `colmap` feature_extractor, exhaustive_matcher, mapper and
/// image_undistorter on the CPU, one after the other, with their output in work/STEP.log. The result is work/dense, a
/// dense workspace without depth maps, of the largest model; how many photographs it holds is noted. Options whose
/// names differ between versions (3.8 to 4.2) are asked of the installed one. A step that was done for the same
/// photographs (names, sizes and times) and size is not done again. max_image_size: of the undistorted photographs,
/// pixels; 0 = theirs. work is locked against other runs, by the colmap that is running, too. When we are asked to
/// stop, colmap ends within a second. Fails (kInput) if colmap is not installed or fails, the folder can't be read,
/// holds fewer than three photographs or holds work, or another run works there, and (kStopped).
Expected<void> run_colmap(const std::filesystem::path& photos, const std::filesystem::path& work, int max_image_size,
                          Progress& progress);

}  // namespace quorum
