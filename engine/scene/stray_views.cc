#include "engine/scene/stray_views.h"

#include <algorithm>

namespace quorum {

std::vector<int> stray_views(const Scene& scene, double far) {
  constexpr double kRounding = 1e-9;
  const std::size_t count = scene.views.size();
  if (count == 0) return {};
  std::vector<Eigen::Vector3d> centers;
  for (const View& view : scene.views) centers.push_back(view.camera.center());
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& center : centers) values.push_back(center(axis));
    std::ranges::sort(values);
    middle(axis) = values[count / 2];
  }
  std::vector<double> distances;
  for (const Eigen::Vector3d& center : centers) distances.push_back((center - middle).norm());
  std::vector<double> sorted = distances;
  std::ranges::sort(sorted);
  const double near = sorted[(2 * count + 2) / 3 - 1];
  std::vector<int> stray;
  for (std::size_t view = 0; view < count; ++view)
    if (near > kRounding * middle.norm() && distances[view] > far * near) stray.push_back(static_cast<int>(view));
  return stray;
}

void leave_out(Scene& scene, const std::vector<int>& views) {
  std::vector<int> place(scene.views.size(), 0);  // of each view afterwards, or -1
  for (const int view : views) place[static_cast<std::size_t>(view)] = -1;
  int next = 0;
  for (int& at : place)
    if (at == 0) at = next++;
  const auto move_all = [&place](std::vector<int>& list) {
    for (int& view : list) view = place[static_cast<std::size_t>(view)];
    std::erase(list, -1);
  };
  for (auto view = views.rbegin(); view != views.rend(); ++view) scene.views.erase(scene.views.begin() + *view);
  for (View& view : scene.views) {
    move_all(view.neighbors);
    view.is_copy.reset();
  }
  std::erase_if(scene.points, [&](SparsePoint& point) {
    const bool was_seen = !point.views.empty();
    move_all(point.views);
    return was_seen && point.views.empty();
  });
}

}  // namespace quorum
