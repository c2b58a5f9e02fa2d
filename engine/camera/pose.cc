#include "engine/camera/pose.h"

#include <Eigen/Geometry>

namespace quorum {

Eigen::Matrix3d rotation_of_quaternion(const std::array<double, 4>& quaternion) {
  const auto& [w, x, y, z] = quaternion;
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

std::array<double, 4> quaternion_of_rotation(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Vector3d translation_of_center(const Eigen::Matrix3d& camera_from_world, const Eigen::Vector3d& center) {
  return -(camera_from_world * center);
}

}  // namespace quorum
