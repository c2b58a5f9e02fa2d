// One scene in the formats that are read, each written by the rules of the format.
#pragma once

#include <filesystem>

#include "engine/scene/scene.h"
#include "tests/support/colmap_scene.h"

namespace quorum {

/// Writes the model, of cameras PINHOLE, with its photographs into the folders colmap, mvsnet, transforms and bundler,
/// and gives the scene that read_colmap reads. mvsnet has other depth ranges and pairs; bundler has other intrinsics,
/// one camera more, which was not found, and three points of its own.
Scene write_scene_formats(const std::filesystem::path& folder, const ColmapModel& model);

}  // namespace quorum
