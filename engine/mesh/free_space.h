// Which of the voxels outside the surface a camera can have come to: the free space around the object.
#pragma once

#include <vector>

#include "engine/volume/voxel_grid.h"

namespace quorum {

/// The voxels outside that a cube of 3 x 3 x 3 voxels covers where it comes from the border of the grid, or from one of
/// the 27 blocks around a camera, without leaving the outside, and one more around these. What is left out are
/// cavities, and the tunnels that single wrong depths carve behind a surface. outside: of all blocks of the grid.
/// cameras: in the world, anywhere.
std::vector<BlockBits> find_free_space(const std::vector<BlockBits>& outside, const VoxelGrid& grid,
                                       const std::vector<Eigen::Vector3d>& cameras);

/// The voxels of a block that lie at the border of the grid.
BlockBits border_voxels(const VoxelGrid& grid, std::uint32_t index);

}  // namespace quorum
