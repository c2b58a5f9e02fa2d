#include "engine/scene/select_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "engine/core/option.h"
#include "engine/scene/copies.h"
#include "engine/scene/parallax.h"

namespace quorum {

namespace {

/// What can't be a neighbor, whatever a rule says.
using Excluded = std::function<bool(int view)>;

std::vector<int> select_by_angle(const Scene& scene, int reference, const SelectViewsOptions& options,
                                 const Excluded& excluded) {
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
  // A heap, since of many candidates a few are looked at.
  std::ranges::make_heap(candidates, std::greater());

  std::vector<int> chosen;
  while (!candidates.empty() && static_cast<int>(chosen.size()) < options.neighbor_count) {
    std::ranges::pop_heap(candidates, std::greater());
    const int view = candidates.back().second;
    candidates.pop_back();
    const bool apart = std::all_of(chosen.begin(), chosen.end(),
                                   [&](int other) { return angle_between(view, other) >= options.min_angle_deg; });
    if (apart && !excluded(view)) chosen.push_back(view);
  }
  return chosen;
}

/// A point that the reference view sees, as a candidate sees it.
struct SharedPoint {
  std::size_t index = 0;      ///< in the list of the reference's points
  Eigen::Vector3d direction;  ///< from the point to the candidate
  double angle_deg = 0.0;     ///< between the rays of the reference and of the candidate
  double weight = 0.0;
};

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180.0 / std::numbers::pi;
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
      shared[view].push_back({index, direction, angle, angle_weight(angle) * resolution_weight(ratio)});
    }
    ++index;
  }
  const double least_deg = least_parallax_deg(camera);
  std::erase_if(shared, [&](auto& candidate) {
    auto& points = candidate.second;
    std::vector<double> angles;
    for (const SharedPoint& point : points) angles.push_back(point.angle_deg);
    const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
    std::nth_element(angles.begin(), middle, angles.end());
    return *middle < least_deg;
  });
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
    const std::vector<SharedPoint> taken = std::move(candidates[best]);
    candidates.erase(best);
    if (is_copy(scene, best)) continue;
    chosen.push_back(best);
    for (auto& [view, points] : candidates) weigh_down_what_is_seen(points, taken);
  }
  return chosen;
}

/// Copies and views from the reference's place.
Excluded blind_to(const Scene& scene, int reference) {
  const Camera& camera = scene.views[static_cast<std::size_t>(reference)].camera;
  return [&scene, &camera,
          points = sample_rays(scene.views[static_cast<std::size_t>(reference)], scene.bounds)](int view) {
    const Camera& other = scene.views[static_cast<std::size_t>(view)].camera;
    return (!points.empty() && parallax_deg(points, other.center()) < least_parallax_deg(camera)) ||
           is_copy(scene, view);
  };
}

std::vector<int> select_given(const Scene& scene, int reference, const SelectViewsOptions& options) {
  std::vector<int> chosen = scene.views[static_cast<std::size_t>(reference)].neighbors;
  std::erase_if(chosen, blind_to(scene, reference));
  if (chosen.size() > static_cast<std::size_t>(options.neighbor_count))
    chosen.resize(static_cast<std::size_t>(options.neighbor_count));
  return chosen;
}

/// By the paper's rule where it is not blind: where the views it takes have half the parallax of the best ones.
std::vector<int> select_by_cameras(const Scene& scene, int reference, const SelectViewsOptions& options) {
  constexpr double kBlind = 0.5;
  std::vector<int> by_angle = select_by_angle(scene, reference, options, blind_to(scene, reference));
  std::vector<int> by_parallax = select_by_parallax(scene, reference, options.neighbor_count, options.max_angle_deg);
  const auto score = [&](const std::vector<int>& neighbors) {
    return parallax_score(scene, reference, neighbors, options.max_angle_deg);
  };
  return score(by_angle) < kBlind * score(by_parallax) ? by_parallax : by_angle;
}

}  // namespace

std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options) {
  if (options.rule == ViewRule::kAngle) return select_by_angle(scene, reference, options, [](int) { return false; });
  if (is_copy(scene, reference)) return {};
  if (options.rule == ViewRule::kPoints) return select_by_points(scene, reference, options);
  if (options.rule == ViewRule::kParallax)
    return select_by_parallax(scene, reference, options.neighbor_count, options.max_angle_deg);
  constexpr std::size_t kEnough = 2;  // the paper, 4.3: every point is seen in at least three views
  std::vector<int> chosen = select_given(scene, reference, options);
  if (chosen.size() < kEnough && !scene.points.empty()) chosen = select_by_points(scene, reference, options);
  if (chosen.size() < kEnough) chosen = select_by_cameras(scene, reference, options);
  return chosen;
}

Error no_neighbors_error(const Scene& scene, const SelectViewsOptions& options) {
  const auto from_one_place = [&](const View& view) {
    const auto points = sample_rays(view, scene.bounds);
    return std::ranges::all_of(scene.views, [&](const View& other) {
      return parallax_deg(points, other.camera.center()) < least_parallax_deg(view.camera);
    });
  };
  if (options.rule != ViewRule::kAngle && scene.views.size() > 1 && std::ranges::all_of(scene.views, from_one_place))
    return {ErrorKind::kInput,
            "all photographs are from about one place, which shows no depth; take them from places that are apart by a "
            "tenth of the distance to the object, or check the unit of the bounds"};
  return {ErrorKind::kInput, "no view has two neighbor views; give photographs taken from closer directions, or " +
                                 option_name("max-angle")};
}

}  // namespace quorum
