#include "engine/scene/select_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace quorum {

Expected<void> SelectViewsOptions::check() const {
  const auto wrong = [](std::string text) { return failure(ErrorKind::kUsage, std::move(text)); };
  if (neighbor_count < 2 || neighbor_count > 32)
    return wrong(fmt::format("--neighbors {}: give 2 to 32", neighbor_count));
  if (!(min_angle_deg >= 0.0 && min_angle_deg <= 90.0))
    return wrong(fmt::format("--min-angle {}: give 0 to 90 degrees", min_angle_deg));
  if (!(max_angle_deg >= 1.0 && max_angle_deg <= 180.0))
    return wrong(fmt::format("--max-angle {}: give 1 to 180 degrees", max_angle_deg));
  return {};
}

namespace {

std::vector<int> select_by_angle(const Scene& scene, int reference, const SelectViewsOptions& options) {
  const auto angle_between = [&](int a, int b) {
    return optical_axis_angle_deg(scene.views[static_cast<std::size_t>(a)].camera,
                                  scene.views[static_cast<std::size_t>(b)].camera);
  };
  std::vector<std::pair<double, int>> candidates;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    if (view == reference) continue;
    const double angle = angle_between(reference, view);
    if (angle >= options.min_angle_deg && angle <= options.max_angle_deg) candidates.emplace_back(angle, view);
  }
  std::sort(candidates.begin(), candidates.end());

  std::vector<int> chosen;
  for (const auto& [angle, view] : candidates) {
    if (static_cast<int>(chosen.size()) == options.neighbor_count) break;
    const bool apart = std::all_of(chosen.begin(), chosen.end(), [&, candidate = view](int other) {
      return angle_between(candidate, other) >= options.min_angle_deg;
    });
    if (apart) chosen.push_back(view);
  }
  return chosen;
}

/// A point that the reference view sees, as a candidate sees it.
struct SharedPoint {
  std::size_t index = 0;      ///< in the list of the reference's points
  Eigen::Vector3d direction;  ///< from the point to the candidate
  double weight = 0.0;
};

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// How well two rays fix a point.
double angle_weight(double angle) {
  constexpr double kEnough = 10.0;
  return std::min(1.0, angle * angle / (kEnough * kEnough));
}

/// ratio: pixels of the candidate to one of the reference, along a line.
double resolution_weight(double ratio) { return ratio < 1.0 ? ratio : std::min(1.0, 2.0 / ratio); }

double pixels_per_unit(const Camera& camera, const Eigen::Vector3d& point) {
  const double depth = camera.to_camera(point).z();
  return depth > 0 ? (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)) / (2.0 * depth) : 0.0;
}

/// The points that each other view shares with the reference, with their first weights.
std::map<int, std::vector<SharedPoint>> shared_points(const Scene& scene, int reference, double max_angle_deg) {
  std::map<int, std::vector<SharedPoint>> shared;
  const Camera& camera = scene.views[static_cast<std::size_t>(reference)].camera;
  std::size_t index = 0;
  for (const SparsePoint& point : scene.points) {
    if (!std::ranges::binary_search(point.views, reference)) continue;
    const Eigen::Vector3d to_reference = (camera.center() - point.position).normalized();
    const double resolution = pixels_per_unit(camera, point.position);
    if (resolution <= 0) continue;
    for (const int view : point.views) {
      if (view == reference) continue;
      const Camera& other = scene.views[static_cast<std::size_t>(view)].camera;
      const Eigen::Vector3d direction = (other.center() - point.position).normalized();
      const double angle = angle_deg(direction, to_reference);
      if (angle > max_angle_deg) continue;
      const double ratio = pixels_per_unit(other, point.position) / resolution;
      shared[view].push_back({index, direction, angle_weight(angle) * resolution_weight(ratio)});
    }
    ++index;
  }
  return shared;
}

/// Both lists ascend by index.
void weigh_down_what_is_seen(std::vector<SharedPoint>& points, const std::vector<SharedPoint>& taken) {
  auto other = taken.begin();
  for (SharedPoint& point : points) {
    while (other != taken.end() && other->index < point.index) ++other;
    if (other == taken.end()) return;
    if (other->index == point.index) point.weight *= angle_weight(angle_deg(point.direction, other->direction));
  }
}

std::vector<int> select_by_points(const Scene& scene, int reference, const SelectViewsOptions& options) {
  constexpr double kLeastShare = 0.02;
  auto candidates = shared_points(scene, reference, options.max_angle_deg);
  std::vector<int> chosen;
  double first_score = 0.0;
  while (static_cast<int>(chosen.size()) < options.neighbor_count) {
    int best = -1;
    double best_score = 0.0;
    for (const auto& [view, points] : candidates) {
      double score = 0.0;
      for (const SharedPoint& point : points) score += point.weight;
      if (score > best_score) {
        best_score = score;
        best = view;
      }
    }
    if (chosen.empty()) first_score = best_score;
    if (best < 0 || best_score < kLeastShare * first_score) break;
    chosen.push_back(best);
    const std::vector<SharedPoint> taken = std::move(candidates[best]);
    candidates.erase(best);
    for (auto& [view, points] : candidates) weigh_down_what_is_seen(points, taken);
  }
  return chosen;
}

}  // namespace

std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options) {
  const std::vector<int>& given = scene.views[static_cast<std::size_t>(reference)].neighbors;
  if (options.rule == ViewRule::kAutomatic && !given.empty()) {
    const std::size_t count = std::min(given.size(), static_cast<std::size_t>(options.neighbor_count));
    return {given.begin(), given.begin() + static_cast<std::ptrdiff_t>(count)};
  }
  if (options.rule == ViewRule::kPoints || (options.rule == ViewRule::kAutomatic && !scene.points.empty()))
    return select_by_points(scene, reference, options);
  return select_by_angle(scene, reference, options);
}

}  // namespace quorum
