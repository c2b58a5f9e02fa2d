// The triangles of one depth map: those between neighboring pixels that do not span a depth discontinuity (the paper,
// section 2.2; Curless and Levoy 1996). A sample in no triangle is gone: that is the paper's outlier filter.
// Twin of shaders/range_surface.comp.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/depth/depth_map.h"
#include "engine/volume/fusion_options.h"
#include "shaders/layout.h"

namespace quorum {

RangeSurfaceParams make_range_surface_params(const Camera& camera, int width, int height, const FusionOptions& options);

/// Unit normals of the planes that pixels lie on, in the camera frame, a word each as shaders/layout.h has it; 0 for
/// the zero vector.
Grid<std::uint32_t> pack_normals(const Grid<Eigen::Vector3f>& normals);

/// Bits kCell… of the cell whose first pixel is (x, y), for every pixel; 0 in the last column and row. normals: packed;
/// without them steep edges are not held against planes.
Grid<std::uint32_t> range_surface(const Grid<float>& depth, const RangeSurfaceParams& params,
                                  const Grid<std::uint32_t>& normals = {});

}  // namespace quorum
