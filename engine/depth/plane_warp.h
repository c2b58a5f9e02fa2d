// Where a reference pixel lands in a neighbor view, on a plane of equal depth (DESIGN: a homography per depth).
#pragma once

#include "engine/camera/camera.h"
#include "shaders/layout.h"

namespace quorum {

/// The warp from a reference view to a neighbor, computed in double and rounded once.
PlaneWarp make_plane_warp(const Camera& reference, const Camera& neighbor);

/// A position in a neighbor image, in 1/256 pixel. inside: the image has it, and the point is before the camera; u and
/// v are 0 otherwise.
struct Projection {
  int u = 0;
  int v = 0;
  bool inside = false;
};

/// Projects pixel (x, y) on the plane at inverse_depth into a neighbor of the given size.
/// Twin: project in shaders/lib/project.glsl.
Projection project(const PlaneWarp& warp, int x, int y, float inverse_depth, int neighbor_width, int neighbor_height);

}  // namespace quorum
