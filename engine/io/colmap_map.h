// The maps of COLMAP's dense workspaces: "width&height&channels&", then little-endian floats, row by row, one channel
// after the other.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "engine/core/error.h"
#include "engine/core/grid.h"

namespace quorum {

/// Writes a map of one channel. Fails (kInput) if the file can't be written.
Expected<void> write_colmap_map(const std::filesystem::path& path, const Grid<float>& map);

/// Writes a map of three channels, x, y and z.
Expected<void> write_colmap_map(const std::filesystem::path& path, const Grid<Eigen::Vector3f>& map);

}  // namespace quorum
