// The lattice of the volume, and the blocks of voxels that are stored.
//
// Voxels are the points of a regular lattice over the bounds. 8 x 8 x 8 of them make a block; a block is named by its
// index x + blocks[0] * (y + blocks[1] * z). Only blocks near a surface are stored, in ascending order of their index.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"
#include "engine/volume/fusion_options.h"
#include "shaders/layout.h"

namespace quorum {

struct VoxelGrid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< position of voxel (0, 0, 0), scene units
  double voxel_size = 0.0;                           ///< scene units
  double truncation = 0.0;                           ///< scene units
  std::array<int, 3> blocks = {0, 0, 0};             ///< along x, y, z
  bool is_coarse = false;  ///< automatic voxels are larger than a pixel's footprint, of which there would be too many

  [[nodiscard]] std::size_t block_count() const {
    return static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) *
           static_cast<std::size_t>(blocks[2]);
  }
  [[nodiscard]] std::array<int, 3> block_position(std::uint32_t index) const {
    const int i = static_cast<int>(index);
    return {i % blocks[0], i / blocks[0] % blocks[1], i / (blocks[0] * blocks[1])};
  }
  [[nodiscard]] std::uint32_t block_index(int x, int y, int z) const {
    return static_cast<std::uint32_t>(x + blocks[0] * (y + blocks[1] * z));
  }
};

/// The lattice over the scene's bounds and one truncation more on each side. Automatic voxel size: the median of a
/// pixel's footprint at the sparse points within the bounds, over the views that see them, or, without points, at the
/// center of the bounds, over all views, or, if a camera stands inside the bounds, at points on all views' rays
/// (sample_rays), and steps of a quarter coarser where that would make more than 2^30 blocks; automatic truncation: 3
/// voxels, or 4 of a distance along the line of sight.
/// Fails (kUsage) if voxels of a given size make more than 2^30 blocks, or the truncation is out of 1.5..32 voxels.
Expected<VoxelGrid> make_voxel_grid(const Scene& scene, const FusionOptions& options);

/// One voxel: sums over the views that saw it. Integers, so the order of the views does not matter.
struct Voxel {
  std::int32_t weight = 0;    ///< in 1 / kWeightScale
  std::int32_t distance = 0;  ///< weight · signed distance in truncation / kDistanceScale; positive before the surface
  std::int32_t color[3] = {};  ///< weight · red, green, blue in 8 bits
};
static_assert(sizeof(Voxel) == kVoxelWords * 4);

/// One bit for each voxel of a block: bit x + 8 y of word z.
using BlockBits = std::array<std::uint64_t, kBlockSide>;

/// The stored blocks: kBlockVoxels voxels each, x fastest, in the order of indices, which ascends.
struct BlockPool {
  std::vector<std::uint32_t> indices;
  std::vector<Voxel> voxels;
};

}  // namespace quorum
