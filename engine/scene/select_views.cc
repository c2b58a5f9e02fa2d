#include "engine/scene/select_views.h"

#include <fmt/format.h>

#include <algorithm>
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

std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options) {
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

}  // namespace quorum
