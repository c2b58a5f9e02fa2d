// Space carving (Curless and Levoy 1996, section 4): which voxels a view looks through, so that nothing can be there.
// Twin of shaders/carve_blocks.comp.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// The depth of a pixel of the background, where nothing is.
constexpr float kBackgroundDepth = -1.0F;

/// A view's surface as carving takes it, all of the view's size: depth with kBackgroundDepth where there is nothing;
/// cells from range_surface, weights from weigh_surface.
struct CarvingSurface {
  const Grid<float>& depth;
  const Grid<std::uint32_t>& cells;
  const Grid<std::uint32_t>& weights;
};

/// Indices of the blocks of the grid in which the view may look through a voxel, ascending: those before a surface, or
/// on the line of sight of a pixel of the background. A few more than that.
std::vector<std::uint32_t> blocks_in_sight(const Grid<float>& depth, const Camera& camera, const VoxelGrid& grid);

/// Sets the bits of the listed blocks' voxels whose center projects into a triangle and lies before it by more than the
/// truncation, or into a cell of four pixels of the background. params: from make_integrate_params. empty: of all
/// blocks of the grid. Equal at every SIMD level, byte by byte.
void carve_blocks(const CarvingSurface& surface, const std::vector<std::uint32_t>& list, const IntegrateParams& params,
                  SimdLevel simd, std::vector<BlockBits>& empty);

}  // namespace quorum
