// The volume in parts, for volumes that do not fit the memory as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/volume/voxel_grid.h"

namespace quorum {

/// Blocks that are filled at once. The first core_count of them belong to the slab; the others are what marching cubes
/// needs beside these: stored neighbors one further along x, y or z, which come again as the core of a later slab.
struct Slab {
  std::vector<std::uint32_t> blocks;  ///< ascending
  std::size_t core_count = 0;
};

/// A block and its three neighbors.
constexpr std::size_t kLeastSlabBlocks = 4;

/// The slab whose core begins at blocks[first] and is as long as it can be before blocks[end] with max_blocks in all
/// (kLeastSlabBlocks or more). blocks: all stored blocks, ascending. Empty if first is the end.
Slab make_slab(const std::vector<std::uint32_t>& blocks, std::size_t first, std::size_t end, const VoxelGrid& grid,
               std::size_t max_blocks);

}  // namespace quorum
