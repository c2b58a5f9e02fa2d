// The depths that are tested in one reference view, and which of them each pixel's ray tests.
#pragma once

#include <vector>

#include "engine/core/bounds.h"
#include "engine/core/error.h"
#include "engine/core/grid.h"
#include "engine/depth/sweep_options.h"
#include "engine/image/image.h"
#include "engine/scene/scene.h"
#include "shaders/layout.h"

namespace quorum {

/// Depth samples of a view at the distance of the second pass. The first pass takes every refinement-th, from 0.
struct DepthPlanes {
  std::vector<float> depth;          ///< scene units
  std::vector<float> inverse_depth;  ///< the same planes, 1 / depth rounded once
  int refinement = 1;                ///< planes of the second pass to one of the first

  /// Mean distance of the planes of the first pass, 1 / scene units.
  [[nodiscard]] float step() const;
};

/// Planes that cover the bounds as seen from scene.views[reference], within the view's depth range if it has one.
/// With options.depth_step the depths of the first pass are that far apart, as in the paper (4.1). Automatic: equally
/// spaced in inverse depth, so that the projection of a point in the bounds moves by at most options.step_pixels in
/// any of the neighbors from one plane of the first pass to the next; if the view does not show the whole box, along
/// its own rays where the neighbor shows them. In a view whose camera stands in the bounds the planes begin where two
/// neighbors see what it sees.
/// Fails (kUsage) if that makes more than 65,535 planes, (kInput) if no part of the bounds is before the camera.
Expected<DepthPlanes> make_depth_planes(const Scene& scene, int reference, const std::vector<int>& neighbors,
                                        const SweepOptions& options);

/// Per pixel the planes of the first pass to test, as indices of DepthPlanes (multiples of refinement): those where the
/// ray is inside the bounds, and one more at either end, so that the second pass reaches the faces of the box. Empty
/// where the ray misses the bounds, where the mask is 0, and within radius pixels of the image border, where the window
/// would leave the photograph.
Grid<PlaneRange> make_plane_ranges(const View& view, const Bounds& bounds, const Mask& mask, const DepthPlanes& planes,
                                   int radius);

}  // namespace quorum
