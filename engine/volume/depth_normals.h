// Normals of a depth map, from the map itself.
#pragma once

#include <Eigen/Core>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"

namespace quorum {

/// Per pixel with a depth the unit normal of the plane that fits the depths around it best, in the camera frame, toward
/// the camera; (0, 0, 0) where there is no depth. Planes are fitted to inverse depth, which is linear in the pixel on a
/// plane, over 7 x 7 pixels without those beyond a step (steeper than 4 pixel footprints a pixel). With fewer than
/// three such pixels, or all of them on a line, the normal is opposite to the line of sight. depth: of this camera,
/// scene units, 0 = none. Cannot fail.
Grid<Eigen::Vector3f> depth_normals(const Grid<float>& depth, const Camera& camera);

}  // namespace quorum
