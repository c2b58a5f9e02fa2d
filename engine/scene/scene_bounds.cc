#include "engine/scene/scene_bounds.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/option.h"

namespace quorum {
namespace {

constexpr double kMargin = 0.05;  // of the longest side

/// The value below which a fraction of the values lie; values is reordered and not empty.
double quantile(std::vector<double>& values, double fraction) {
  const auto place = static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// Three times the middle half of the points beyond it, on each axis. Where most points lie in a wall or on the ground,
/// that half has next to no extent across; what stands off it is kept as far as the longest side tells, if it is more
/// than a few mistakes.
Bounds robust_box(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kLeastSpread = 0.25;  // of the longest one
  constexpr double kMany = 0.05;         // points that are no mistakes
  Bounds box;
  Bounds middle_half;
  std::array<std::vector<double>, 3> values;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Eigen::Vector3d& point : points) values[static_cast<std::size_t>(axis)].push_back(point(axis));
    middle_half.low(axis) = quantile(values[static_cast<std::size_t>(axis)], 0.25);
    middle_half.high(axis) = quantile(values[static_cast<std::size_t>(axis)], 0.75);
  }
  const Eigen::Vector3d spread = middle_half.size();
  const double least_spread = kLeastSpread * spread.maxCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& along = values[static_cast<std::size_t>(axis)];
    const double reach = 3.0 * spread(axis);
    const double least_reach = std::max(reach, 3.0 * least_spread);
    const bool many_below = quantile(along, kMany) < middle_half.low(axis) - reach;
    const bool many_above = quantile(along, 1.0 - kMany) > middle_half.high(axis) + reach;
    box.low(axis) = std::max(quantile(along, 0.01), middle_half.low(axis) - (many_below ? least_reach : reach));
    box.high(axis) = std::min(quantile(along, 0.99), middle_half.high(axis) + (many_above ? least_reach : reach));
  }
  return box.expanded(kMargin * box.size().maxCoeff());
}

bool shows(const View& view, const Eigen::Vector3d& point) {
  const Eigen::Vector3d pixel = view.camera.project(point);
  if (!(pixel.z() > 0)) return false;
  if (view.far_depth > 0 && (pixel.z() < view.near_depth || pixel.z() > view.far_depth)) return false;
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= view.width - 1 && pixel.y() <= view.height - 1;
}

/// The point nearest to all optical axes; nothing if these are about parallel, or begin in one point.
std::optional<Eigen::Vector3d> meeting_point(const std::vector<View>& views) {
  constexpr double kRounding = 1e-9;
  double extent = 0.0;
  double magnitude = 0.0;
  for (const View& view : views) {
    extent = std::max(extent, (view.camera.center() - views.front().camera.center()).norm());
    magnitude = std::max(magnitude, view.camera.center().norm());
  }
  if (extent <= kRounding * magnitude) return std::nullopt;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const View& view : views) {
    const Eigen::Vector3d axis = view.camera.optical_axis();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    normal += across;
    right += across * view.camera.center();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  if (solver.eigenvalues()(0) < 1e-4 * solver.eigenvalues()(2)) return std::nullopt;
  return Eigen::Vector3d(normal.ldlt().solve(right));
}

Expected<Bounds> common_field_of_view(const Scene& scene) {
  constexpr int kPixels = 9;  // sampled along each side of an image
  constexpr int kDepths = 17;
  const auto refuse = [] {
    return failure(ErrorKind::kInput, "the views have no common field of view; say where the object is with " +
                                          option_name("bounds") + " \"x0 y0 z0 x1 y1 z1\"");
  };
  const bool ranges = std::ranges::all_of(scene.views, [](const View& view) { return view.far_depth > 0; });
  const auto meeting = meeting_point(scene.views);
  if (!ranges) {  // views that look at one object show where their axes meet; those of a walk or a room don't
    const auto seeing =
        meeting ? std::ranges::count_if(scene.views, [&](const View& view) { return shows(view, *meeting); }) : 0;
    if (4 * static_cast<std::size_t>(seeing) < 3 * scene.views.size()) return refuse();
  }
  const std::size_t wanted = ranges ? 3 : std::max<std::size_t>(3, (scene.views.size() + 1) / 2);
  Bounds box{Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
             Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity())};
  for (const View& view : scene.views) {
    double near = view.near_depth;
    double far = view.far_depth;
    if (!ranges) {
      const double distance = view.camera.to_camera(*meeting).z();
      if (distance <= 0) continue;
      near = 0.1 * distance;
      far = 1.9 * distance;
    }
    for (int i = 0; i < kPixels * kPixels * kDepths; ++i) {
      const double x = (view.width - 1.0) * (i % kPixels) / (kPixels - 1);
      const double y = (view.height - 1.0) * (i / kPixels % kPixels) / (kPixels - 1);
      const double depth = near + (far - near) * (i / (kPixels * kPixels)) / (kDepths - 1);
      const Eigen::Vector3d point = view.camera.unproject(x, y, depth);
      std::size_t count = 0;
      for (const View& other : scene.views) count += &other == &view || shows(other, point) ? 1 : 0;
      if (count < wanted) continue;
      box.low = box.low.cwiseMin(point);
      box.high = box.high.cwiseMax(point);
    }
  }
  if (!box.valid()) return refuse();
  return box.expanded(kMargin * box.size().maxCoeff());
}

}  // namespace

Expected<Bounds> find_bounds(const Scene& scene) {
  constexpr std::size_t kLeastPoints = 20;
  for (const std::size_t least_views : {3U, 2U}) {
    std::vector<Eigen::Vector3d> points;
    for (const SparsePoint& point : scene.points)
      if (point.views.size() >= least_views) points.push_back(point.position);
    if (points.size() >= kLeastPoints) return robust_box(points);
  }
  return common_field_of_view(scene);
}

void find_depth_ranges(Scene& scene) {
  constexpr std::size_t kLeastPoints = 20;
  constexpr double kBeyond = 1.25;
  std::vector<std::vector<double>> depths(scene.views.size());
  for (const SparsePoint& point : scene.points) {
    if ((point.position.array() < scene.bounds.low.array()).any() ||
        (point.position.array() > scene.bounds.high.array()).any())
      continue;
    for (const int view : point.views) {
      const double depth = scene.views[static_cast<std::size_t>(view)].camera.to_camera(point.position).z();
      if (depth > 0) depths[static_cast<std::size_t>(view)].push_back(depth);
    }
  }
  for (std::size_t view = 0; view < depths.size(); ++view) {
    if (depths[view].size() < kLeastPoints) continue;
    scene.views[view].near_depth = quantile(depths[view], 0.01) / kBeyond;
    scene.views[view].far_depth = quantile(depths[view], 0.99) * kBeyond;
  }
}

}  // namespace quorum
