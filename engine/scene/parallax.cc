#include "engine/scene/parallax.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/scene/copies.h"
#include "engine/scene/ray_box.h"

namespace quorum {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;  // in degrees
constexpr double kWideAngleDeg = 45.0;

const View& view_at(const Scene& scene, int index) { return scene.views[static_cast<std::size_t>(index)]; }

double chord_angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 2.0 * std::asin(std::min(1.0, (a - b).norm() / 2.0)) * kRadian;
}

/// 0 if there are none; values is reordered.
double median_or_0(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A point of the reference, as a candidate sees it.
struct SeenPoint {
  std::size_t index = 0;      ///< in the list of the reference's points
  Eigen::Vector3d direction;  ///< from the point to the candidate
  double weight = 0.0;
};

struct Candidate {
  int view = -1;
  std::vector<SeenPoint> points;  ///< ascending by index

  [[nodiscard]] double score() const {
    double sum = 0.0;
    for (const SeenPoint& point : points) sum += point.weight;
    return sum;
  }
};

/// Empty where the view has no parallax to the reference, or shows none of the points.
Candidate look_at(const Scene& scene, const std::vector<RayPoint>& points, int view, double least_deg, double max_deg) {
  const View& other = view_at(scene, view);
  const Eigen::Vector3d center = other.camera.center();
  Candidate candidate{view, {}};
  if (parallax_deg(points, center) < least_deg) return candidate;
  std::vector<double> angles;
  for (std::size_t index = 0; index < points.size(); ++index) {
    const RayPoint& point = points[index];
    if (!is_in_image(other, point.position)) continue;
    const Eigen::Vector3d direction = (center - point.position).normalized();
    const double angle = chord_angle_deg(direction, point.to_view);
    if (angle >= max_deg) continue;
    angles.push_back(angle);
    const double ratio = pixels_per_unit(other.camera, point.position) / point.pixels_per_unit;
    const double fall_off = angle <= kWideAngleDeg ? 1.0 : (max_deg - angle) / (max_deg - kWideAngleDeg);
    candidate.points.push_back({index, direction, angle_weight(angle) * resolution_weight(ratio) * fall_off});
  }
  if (median_or_0(angles) < least_deg) candidate.points.clear();
  return candidate;
}

/// The views that are looked at, ascending: all others, or, of many, every so many-th of the nearest.
std::vector<int> candidate_views(const Scene& scene, int reference) {
  constexpr std::size_t kStep = 8;
  std::vector<int> views;
  if (scene.views.size() <= kManyViews) {
    for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
      if (view != reference) views.push_back(view);
    return views;
  }
  const Eigen::Vector3d center = view_at(scene, reference).camera.center();
  std::vector<std::pair<double, int>> near;
  near.reserve(scene.views.size());
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
    if (view != reference) near.emplace_back((view_at(scene, view).camera.center() - center).squaredNorm(), view);
  const auto end = near.begin() + kStep * kCandidates;
  std::nth_element(near.begin(), end, near.end());
  std::sort(near.begin(), end);
  for (auto place = near.begin(); place < end; place += kStep) views.push_back(place->second);
  std::ranges::sort(views);
  return views;
}

void weigh_down_what_is_seen(std::vector<SeenPoint>& points, const std::vector<SeenPoint>& taken) {
  auto other = taken.begin();
  for (SeenPoint& point : points) {
    while (other != taken.end() && other->index < point.index) ++other;
    if (other == taken.end()) return;
    if (other->index == point.index) point.weight *= angle_weight(chord_angle_deg(point.direction, other->direction));
  }
}

/// sample_rays, of the given share of each ray's span around its middle.
std::vector<RayPoint> sample_around_middle(const View& view, const Bounds& bounds, double share) {
  constexpr int kRays = 8;  // along each side of the image
  constexpr int kDepths = 8;
  std::vector<RayPoint> points;
  const Eigen::Vector3d center = view.camera.center();
  for (int i = 0; i < kRays * kRays; ++i) {
    const double x = view.width * (i % kRays + 0.5) / kRays - 0.5;
    const double y = view.height * (i / kRays + 0.5) / kRays - 0.5;
    const Eigen::Vector3d ray = view.camera.unproject(x, y, 1.0) - center;
    RaySpan span = ray_in_box(center, ray, bounds);
    if (view.far_depth > 0) span = {std::max(span.enter, view.near_depth), std::min(span.leave, view.far_depth)};
    if (!(span.enter < span.leave) || !std::isfinite(span.leave)) continue;
    for (int k = 0; k < kDepths; ++k) {
      const double place = 0.5 + share * ((k + 0.5) / kDepths - 0.5);
      const double depth = span.enter + (span.leave - span.enter) * place;
      const Eigen::Vector3d position = center + depth * ray;
      points.push_back({position, -ray.normalized(), pixels_per_unit(view.camera, position)});
    }
  }
  return points;
}

}  // namespace

std::vector<RayPoint> sample_rays(const View& view, const Bounds& bounds) {
  return sample_around_middle(view, bounds, 1.0);
}

double least_parallax_deg(const Camera& camera) {
  return std::max(kLeastParallaxDeg, kLeastParallaxPixels / focal_pixels(camera) * kRadian);
}

double parallax_deg(const std::vector<RayPoint>& points, const Eigen::Vector3d& other_center) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < points.size(); i += kRayStride)
    angles.push_back(chord_angle_deg((other_center - points[i].position).normalized(), points[i].to_view));
  return median_or_0(angles);
}

double angle_weight(double angle_deg) {
  constexpr double kEnough = 10.0;
  return std::min(1.0, angle_deg * angle_deg / (kEnough * kEnough));
}

double resolution_weight(double ratio) { return ratio < 1.0 ? ratio : std::min(1.0, 2.0 / ratio); }

double focal_pixels(const Camera& camera) { return (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)) / 2.0; }

double pixels_per_unit(const Camera& camera, const Eigen::Vector3d& point) {
  const double depth = camera.to_camera(point).z();
  return depth > 0 ? focal_pixels(camera) / depth : 0.0;
}

bool is_in_image(const View& view, const Eigen::Vector3d& point) {
  const Eigen::Vector3d pixel = view.camera.project(point);
  return pixel.z() > 0 && pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= view.width - 0.5 &&
         pixel.y() <= view.height - 0.5;
}

std::vector<int> select_by_parallax(const Scene& scene, int reference, int count, double max_angle_deg) {
  constexpr double kLeastShare = 0.02;
  constexpr double kAboutEqual = 1.0 + 1e-9;
  const auto points = sample_rays(view_at(scene, reference), scene.bounds);
  const double least_deg = least_parallax_deg(view_at(scene, reference).camera);
  std::vector<Candidate> candidates;
  for (const int view : candidate_views(scene, reference)) {
    Candidate candidate = look_at(scene, points, view, least_deg, max_angle_deg);
    if (!candidate.points.empty()) candidates.push_back(std::move(candidate));
  }
  std::vector<int> chosen;
  double first_score = 0.0;
  while (static_cast<int>(chosen.size()) < count) {
    auto best = candidates.end();
    double best_score = 0.0;
    for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
      const double score = candidate->score();
      if (score <= best_score * kAboutEqual) continue;
      best_score = score;
      best = candidate;
    }
    if (chosen.empty()) first_score = best_score;
    if (best == candidates.end() || best_score < kLeastShare * first_score) break;
    const Candidate taken = std::move(*best);
    candidates.erase(best);
    if (is_copy(scene, taken.view)) continue;
    chosen.push_back(taken.view);
    for (Candidate& candidate : candidates) weigh_down_what_is_seen(candidate.points, taken.points);
  }
  return chosen;
}

double parallax_score(const Scene& scene, int reference, const std::vector<int>& neighbors, double max_angle_deg) {
  constexpr double kShare = 0.5;
  const auto points = sample_around_middle(view_at(scene, reference), scene.bounds, kShare);
  const double least_deg = least_parallax_deg(view_at(scene, reference).camera);
  std::vector<Candidate> taken;
  double sum = 0.0;
  for (const int neighbor : neighbors) {
    Candidate candidate = look_at(scene, points, neighbor, least_deg, max_angle_deg);
    for (const Candidate& before : taken) weigh_down_what_is_seen(candidate.points, before.points);
    sum += candidate.score();
    taken.push_back(std::move(candidate));
  }
  return sum;
}

}  // namespace quorum
