#include "engine/render/turntable.h"

#include <Eigen/Geometry>
#include <numbers>

namespace quorum {

Eigen::Vector3d mean_up(std::span<const Camera> cameras) {
  constexpr double kAgree = 0.1;  // length of the mean; 1 where all agree
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Camera& camera : cameras) sum -= camera.camera_from_world.row(1).transpose();
  if (!(sum.norm() > kAgree * static_cast<double>(cameras.size()))) return Eigen::Vector3d::Zero();
  return sum.normalized();
}

Eigen::Vector3d middle_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vertex& vertex : mesh.vertices)
    if (vertex.position.allFinite()) box.extend(vertex.position.cast<double>());
  return box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
}

std::vector<Camera> turntable(const Camera& camera, const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                              int count) {
  std::vector<Camera> cameras = {camera};
  for (int step = 1; step < count; ++step) {
    const double angle = 2 * std::numbers::pi * step / count;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    Camera turned = camera;
    turned.camera_from_world = camera.camera_from_world * turn.transpose();
    turned.translation = -turned.camera_from_world * (center + turn * (camera.center() - center));
    cameras.push_back(turned);
  }
  return cameras;
}

}  // namespace quorum
