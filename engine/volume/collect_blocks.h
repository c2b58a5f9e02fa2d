// Which voxel blocks lie within the truncation of a range surface. Blocks are marked in a bit map over the grid, so one
// wild depth costs at most the blocks along its own ray, and all of them inside the bounds.
// Twin of shaders/collect_blocks.comp.
#pragma once

#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

CollectParams make_collect_params(const Camera& camera, int width, int height, const VoxelGrid& grid);

/// Bit map over the blocks of the grid, 32 to a word: 1 where a vertex of the surface (weight above 0) is near.
std::vector<std::uint32_t> collect_blocks(const Grid<float>& depth, const Grid<std::uint32_t>& weights,
                                          const CollectParams& params);

/// Indices of the set bits, ascending.
std::vector<std::uint32_t> block_indices(const std::vector<std::uint32_t>& bits);

}  // namespace quorum
