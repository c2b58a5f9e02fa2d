// A shard's part of the volume as a file: what marching cubes kept of its blocks.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/pipeline/fuse_views.h"

namespace quorum {

/// What the file holds: after a line that names the format, little-endian 64-bit counts and arrays as they lie in
/// memory.
struct SurfacePart {
  std::string record;        ///< what it was made from (Provenance::surface_record)
  std::uint64_t blocks = 0;  ///< that all shards found, not this one alone, as the next two
  std::uint64_t block_views = 0;
  std::uint64_t slabs = 0;
  MeasuredVolume volume;  ///< its grid is not in the file
};

/// Fails (kInput) if it can't be written.
Expected<void> write_surface_part(const std::filesystem::path& path, const SurfacePart& part);

/// The record alone; empty if the file is none, or can't be read.
std::string read_surface_record(const std::filesystem::path& path);

/// Fails (kInput) if the file can't be read or is not whole.
Expected<SurfacePart> read_surface_part(const std::filesystem::path& path);

}  // namespace quorum
