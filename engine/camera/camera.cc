#include "engine/camera/camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace quorum {

Eigen::Vector3d Camera::project(const Eigen::Vector3d& point_in_world) const {
  const Eigen::Vector3d point_in_camera = to_camera(point_in_world);
  const Eigen::Vector3d pixel = intrinsics * point_in_camera;
  return {pixel.x() / pixel.z(), pixel.y() / pixel.z(), point_in_camera.z()};
}

Eigen::Vector3d Camera::unproject(double x, double y, double depth) const {
  const Eigen::Vector3d ray = intrinsics.inverse() * Eigen::Vector3d(x, y, 1.0);
  return camera_from_world.transpose() * (ray * (depth / ray.z()) - translation);
}

double optical_axis_angle_deg(const Camera& a, const Camera& b) {
  const double cosine = std::clamp(a.optical_axis().dot(b.optical_axis()), -1.0, 1.0);
  return std::acos(cosine) * 180.0 / std::numbers::pi;
}

const char* camera_defect(const Camera& camera) {
  constexpr double kRotationTolerance = 1e-3;
  const Eigen::Matrix3d& k = camera.intrinsics;
  if (!k.allFinite() || !camera.camera_from_world.allFinite() || !camera.translation.allFinite())
    return "a camera value is not finite";
  if (k(1, 0) != 0 || k(2, 0) != 0 || k(2, 1) != 0) return "K is not upper triangular";
  if (!(k(0, 0) > 0 && k(1, 1) > 0 && k(2, 2) > 0)) return "K is singular or has a focal length that is not positive";
  if (k(2, 2) != 1) return "K is not scaled to K(2,2) = 1";
  const Eigen::Matrix3d& r = camera.camera_from_world;
  if ((r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kRotationTolerance)
    return "R is not a rotation: its rows are not orthonormal";
  if (r.determinant() < 0) return "R is not a rotation: it mirrors";
  return nullptr;
}

}  // namespace quorum
