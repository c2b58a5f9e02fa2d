#include "engine/volume/depth_normals.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace quorum {
namespace {

constexpr int kRadius = 3;
constexpr double kSteepest = 4.0;  // footprints of a pixel per pixel

/// a x + b y + c of the relative inverse depth around a pixel; false if the pixels don't span a plane.
bool fit_inverse_depth(const Grid<float>& depth, int x, int y, double footprint, Eigen::Vector3d& plane) {
  const double center = static_cast<double>(depth.at(x, y));
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int v = std::max(y - kRadius, 0); v <= std::min(y + kRadius, depth.height - 1); ++v) {
    for (int u = std::max(x - kRadius, 0); u <= std::min(x + kRadius, depth.width - 1); ++u) {
      const double other = static_cast<double>(depth.at(u, v));
      if (other <= 0) continue;
      const double away = std::hypot(u - x, v - y);
      if (std::abs(other - center) > kSteepest * footprint * std::max(1.0, away)) continue;
      const Eigen::Vector3d place(u - x, v - y, 1.0);
      normal += place * place.transpose();
      right += place * (center / other);
    }
  }
  if (normal.determinant() < 1e-9) return false;
  plane = normal.inverse() * right;
  return true;
}

}  // namespace

Grid<Eigen::Vector3f> depth_normals(const Grid<float>& depth, const Camera& camera) {
  Grid<Eigen::Vector3f> normals(depth.width, depth.height, Eigen::Vector3f::Zero());
  const Eigen::Matrix3d ray_from_pixel = camera.intrinsics.inverse();
  const double focal = (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)) / 2.0;
  tbb::parallel_for(0, depth.height, [&](int y) {
    for (int x = 0; x < depth.width; ++x) {
      if (!(depth.at(x, y) > 0.0F)) continue;
      const Eigen::Vector3d ray = ray_from_pixel * Eigen::Vector3d(x, y, 1.0);
      Eigen::Vector3d normal = -ray;
      Eigen::Vector3d plane;
      if (fit_inverse_depth(depth, x, y, static_cast<double>(depth.at(x, y)) / focal, plane)) {
        // A plane n · p = d has the inverse depth n · ray / d, so its coefficients over (x, y, 1) are K^-T n / d.
        plane.z() -= plane.x() * x + plane.y() * y;
        normal = camera.intrinsics.transpose() * plane;
        if (normal.dot(ray) > 0) normal = -normal;
      }
      normals.at(x, y) = normal.normalized().cast<float>();
    }
  });
  return normals;
}

}  // namespace quorum
