#include "engine/scene/copies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quorum {
namespace {

/// parallax_deg(points, other_center) < least_deg, told as soon as half of the points say that it is not, and without
/// the angles themselves: all pairs of views are asked.
bool lacks_parallax(const std::vector<RayPoint>& points, const Eigen::Vector3d& other_center, double least_deg) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;  // of a radian
  const double sine = std::sin(least_deg / kDegrees);
  const std::size_t count = (points.size() + kRayStride - 1) / kRayStride;
  std::size_t enough = count - count / 2;  // points that have it, so that the median has it
  for (std::size_t i = 0; i < points.size(); i += kRayStride) {
    const Eigen::Vector3d to_other = other_center - points[i].position;
    const Eigen::Vector3d& to_view = points[i].to_view;
    const double dot = to_other.dot(to_view);
    const double square = to_other.squaredNorm();
    if (dot > 0 && square - dot * dot < sine * sine * square) continue;
    if (--enough == 0) return false;
  }
  return count > 0;
}

}  // namespace

bool repeats(const View& view, const std::vector<RayPoint>& points, const View& earlier) {
  constexpr double kMostTurn = 0.8;  // cosine between the axes; spares the rest for most pairs
  constexpr double kShare = 0.9;
  constexpr double kLikeResolution = 1.25;
  if (points.empty() || view.camera.optical_axis().dot(earlier.camera.optical_axis()) < kMostTurn) return false;
  const double ratio = focal_pixels(earlier.camera) / focal_pixels(view.camera);
  if (ratio > kLikeResolution || ratio * kLikeResolution < 1.0) return false;
  if (!lacks_parallax(points, earlier.camera.center(), least_parallax_deg(view.camera))) return false;
  const auto seen =
      std::ranges::count_if(points, [&](const RayPoint& point) { return is_in_image(earlier, point.position); });
  return static_cast<double>(seen) >= kShare * static_cast<double>(points.size());
}

bool is_copy(const Scene& scene, int view) {
  const View& later = scene.views[static_cast<std::size_t>(view)];
  if (later.is_copy) return *later.is_copy;
  const auto points = sample_rays(later, scene.bounds);
  for (int earlier = 0; earlier < view; ++earlier)
    if (repeats(later, points, scene.views[static_cast<std::size_t>(earlier)]) && !is_copy(scene, earlier)) return true;
  return false;
}

void mark_copies(Scene& scene) {
  for (View& view : scene.views) view.is_copy.reset();
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const bool copy = is_copy(scene, view);
    scene.views[static_cast<std::size_t>(view)].is_copy = copy;
  }
}

}  // namespace quorum
