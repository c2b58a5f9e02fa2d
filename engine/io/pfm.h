// Float maps as PFM files (Paul Debevec's "portable float map"): one channel or three, rows from the bottom.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/core/grid.h"

namespace quorum {

/// A little-endian PFM of one channel, or of three. A map without values gives a size of 0.
std::string pfm_bytes(const Grid<float>& map);
std::string pfm_bytes(const Grid<Eigen::Vector3f>& map);

/// Writes a one-channel little-endian PFM through a temporary file. A map without values gives a file with a size of
/// 0. Fails (kInput) if the file can't be written.
Expected<void> write_pfm(const std::filesystem::path& path, const Grid<float>& map);

/// Writes a three-channel one in the same way.
Expected<void> write_pfm(const std::filesystem::path& path, const Grid<Eigen::Vector3f>& map);

/// Reads a one-channel PFM of either byte order. The size of the scale is ignored, as other readers do. Fails (kInput)
/// if the header is malformed or the file is shorter or longer than the header says: the message names file and line.
Expected<Grid<float>> read_pfm(const std::filesystem::path& path);

/// Reads a three-channel PFM in the same way.
Expected<Grid<Eigen::Vector3f>> read_pfm_vectors(const std::filesystem::path& path);

}  // namespace quorum
