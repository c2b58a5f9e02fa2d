// A depth map as a mesh: the triangles of its range surface (the paper, section 2.2; its figures 2, 5 and 6 show depth
// maps this way).
#pragma once

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/mesh/mesh.h"

namespace quorum {

/// depth: as a DepthMap holds it; cells: its triangles, from range_surface. A vertex for each pixel that is a corner of
/// a triangle, in the order of the pixels, without normal or confidence; triangles face the camera. Empty if there are
/// no triangles. Cannot fail.
Mesh depth_mesh(const Camera& camera, const Grid<float>& depth, const Grid<std::uint32_t>& cells);

}  // namespace quorum
