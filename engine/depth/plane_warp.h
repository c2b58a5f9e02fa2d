// Where a reference pixel lands in a neighbor view, on a plane of equal depth (a homography per depth).
#pragma once

#include "engine/camera/camera.h"
#include "shaders/layout.h"

namespace quorum {

/// The warp from a reference view to a neighbor, computed in double and rounded once.
PlaneWarp make_plane_warp(const Camera& reference, const Camera& neighbor);

}  // namespace quorum
