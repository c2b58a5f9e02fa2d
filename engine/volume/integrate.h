// Adds one range surface to the voxels near it: signed distance along the normal, weight and color (the paper,
// section 2.2; Curless and Levoy 1996), in integer sums. Twin of shaders/integrate.comp.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/image/padded_image.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// One view's surface as the volume takes it. All of the view's size; cells from range_surface (the last column and row
/// have no triangles), weights from weigh_surface.
struct WeightedSurface {
  const Grid<float>& depth;
  const Grid<std::uint32_t>& cells;
  const Grid<std::uint32_t>& weights;
  const PaddedImage& image;
};

/// params.list_begin and pool_begin are 0: one dispatch over everything.
IntegrateParams make_integrate_params(const Camera& camera, int width, int height, const VoxelGrid& grid);

/// An entry of the list of blocks that a view touches.
struct BlockSlot {
  std::uint32_t index;  ///< of the block in the grid
  std::uint32_t slot;   ///< of the block in the pool
};

/// Slots of the given blocks in a pool; both lists ascend, and the pool holds every block given.
std::vector<BlockSlot> find_slots(const std::vector<std::uint32_t>& blocks, const std::vector<std::uint32_t>& pool);

/// Adds the surface to the listed blocks of the pool. A voxel takes it if its center projects into a triangle and lies
/// within the truncation before it or kBehindShare of the truncation behind it.
/// Equal at every SIMD level, byte by byte.
void integrate(const WeightedSurface& surface, const std::vector<BlockSlot>& list, const IntegrateParams& params,
               SimdLevel simd, std::vector<Voxel>& voxels);

}  // namespace quorum
