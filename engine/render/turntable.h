// Cameras around a thing, for pictures of it from all sides.
#pragma once

#include <span>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/mesh/mesh.h"

namespace quorum {

/// What the pictures of most cameras show as up: a unit vector in the world, or zero where they agree on nothing.
Eigen::Vector3d mean_up(std::span<const Camera> cameras);

/// The middle of the box around all vertices that are finite, world; the origin without any.
Eigen::Vector3d middle_of(const Mesh& mesh);

/// The camera on its way around an axis through center, in count steps of the same angle, the first as it is, counter-
/// clockwise as seen from where the axis points. axis: unit vector, world; count > 0.
std::vector<Camera> turntable(const Camera& camera, const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                              int count);

}  // namespace quorum
