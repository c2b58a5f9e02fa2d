#include "engine/camera/camera.h"

#include <fmt/format.h>

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

std::string absurd_value(const Camera& camera, int width, int height) {
  constexpr double kShortest = 0.1;  // focal lengths, of the larger side
  constexpr double kLongest = 1e5;
  constexpr double kStretched = 10.0;
  constexpr double kOutside = 100.0;  // of the larger side; crops of a large picture lie beside its principal point
  constexpr double kFarthest = 1e13;  // the earth in micrometers
  const Eigen::Matrix3d& k = camera.intrinsics;
  const double side = std::max(width, height);
  for (const double focal : {k(0, 0), k(1, 1)})
    if (focal < kShortest * side || focal > kLongest * side)
      return fmt::format("its focal length {:.6g} is none of a picture of {} x {}, in pixels", focal, width, height);
  if (const double ratio = k(0, 0) / k(1, 1); ratio > kStretched || ratio * kStretched < 1.0)
    return fmt::format("its focal lengths {:.6g} and {:.6g} are those of no camera", k(0, 0), k(1, 1));
  const Eigen::Vector2d off(k(0, 2) - width / 2.0, k(1, 2) - height / 2.0);
  if (off.cwiseAbs().maxCoeff() > kOutside * side)
    return fmt::format("its principal point ({:.6g}, {:.6g}) is far outside of a picture of {} x {}", k(0, 2), k(1, 2),
                       width, height);
  if (const Eigen::Vector3d center = camera.center(); center.cwiseAbs().maxCoeff() > kFarthest)
    return fmt::format("its position ({:.6g} {:.6g} {:.6g}) is beyond all units", center.x(), center.y(), center.z());
  return {};
}

}  // namespace quorum
