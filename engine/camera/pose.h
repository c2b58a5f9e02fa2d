// The other ways to say where a camera is: a quaternion for R, and the center of projection for t. Readers and writers
// of files share them, so that what is written reads back to the last bit.
#pragma once

#include <Eigen/Core>
#include <array>

namespace quorum {

/// The rotation of a quaternion w x y z, which is normalized first; not finite if it is zero.
Eigen::Matrix3d rotation_of_quaternion(const std::array<double, 4>& quaternion);

/// A quaternion w x y z of a rotation. rotation_of_quaternion gives the rotation back but for its last bits, 2e-15.
std::array<double, 4> quaternion_of_rotation(const Eigen::Matrix3d& rotation);

/// The translation of a camera with this center of projection, -R c.
Eigen::Vector3d translation_of_center(const Eigen::Matrix3d& camera_from_world, const Eigen::Vector3d& center);

}  // namespace quorum
