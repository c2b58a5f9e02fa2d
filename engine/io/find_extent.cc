#include "engine/io/find_extent.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/option.h"
#include "engine/depth/coarse_sweep.h"
#include "engine/io/image_store.h"
#include "engine/io/view_list.h"
#include "engine/scene/limit_image_size.h"
#include "engine/scene/local_frame.h"
#include "engine/scene/scene_bounds.h"
#include "engine/scene/stray_views.h"

namespace quorum {
namespace {

/// The scene with small images and the points of a coarse sweep.
Expected<Scene> sweep_small(const Scene& scene) {
  constexpr std::size_t kKeptBytes = std::size_t{64} << 20;
  Scene small = scene;
  limit_image_size(small, kCoarseImageSize);
  ImageStore images(small, kKeptBytes);
  const auto read = [&](int view) -> Expected<PaddedImage> {
    QUORUM_ASSIGN(const auto image, images.image(view));
    return pad_image(*image);
  };
  QUORUM_ASSIGN(small.points, coarse_sweep(small, read));
  return small;
}

void take_range(const View& from, View& to) {
  to.near_depth = from.near_depth;
  to.far_depth = from.far_depth;
}

bool stands_in(const View& view, const Bounds& box) {
  const Eigen::Vector3d center = view.camera.center();
  return (center.array() >= box.low.array()).all() && (center.array() <= box.high.array()).all();
}

/// Bounds and ranges of the scene as it is.
Expected<void> find_extent_of_all(Scene& scene) {
  if (const auto known = find_bounds(scene)) {
    scene.bounds = *known;
    return {};
  }
  QUORUM_ASSIGN(auto small, sweep_small(scene));
  const auto found = find_bounds(small);
  if (!found)
    return failure(ErrorKind::kInput,
                   "the views have no common field of view, and the photographs show no depth: they are from about one "
                   "place, or have no texture; take them from places that are apart, or say where the object is with " +
                       option_name("bounds") + " \"x0 y0 z0 x1 y1 z1\"");
  small.bounds = *found;
  find_depth_ranges(small);
  scene.bounds = small.bounds;
  for (std::size_t view = 0; view < scene.views.size(); ++view) take_range(small.views[view], scene.views[view]);
  return {};
}

/// "2 of 6 cameras stand more than 100 times as far away as the others reach, as wrong poses put them: a.png, b.png".
std::string tell_stray(const Scene& scene, const std::vector<int>& stray, double far) {
  std::vector<std::string> names;
  for (const int view : stray) names.push_back(scene.views[static_cast<std::size_t>(view)].image_name);
  return fmt::format(
      "{} of {} cameras stand more than {} times as far away as the others reach, as wrong poses put them: {}",
      stray.size(), scene.views.size(), far, names_in_short(names));
}

/// Leaves these views out, if the others have an extent.
bool find_extent_without(Scene& scene, const std::vector<int>& stray, double far) {
  if (stray.empty() || scene.views.size() < stray.size() + 3) return false;
  Scene rest = scene;
  leave_out(rest, stray);
  enter_local_frame(rest);
  if (!find_extent_of_all(rest)) return false;
  rest.notes.push_back(tell_stray(scene, stray, far) + "; they are left out");
  scene = std::move(rest);
  return true;
}

}  // namespace

Expected<void> find_extent(Scene& scene) {
  constexpr double kAbsurd = 30.0;  // a box that holds such a camera's view, too, is none
  constexpr double kFar = 5.0;      // where there is none otherwise
  if (scene.points.empty() && find_extent_without(scene, stray_views(scene, kAbsurd), kAbsurd)) return {};
  const auto found = find_extent_of_all(scene);
  if (found || found.error().kind != ErrorKind::kInput) return found;
  const std::vector<int> stray = stray_views(scene, kFar);
  if (stray.empty() || find_extent_without(scene, stray, kFar)) return stray.empty() ? found : Expected<void>();
  return failure(found.error().kind, found.error().message + "; " + tell_stray(scene, stray, kFar));
}

Expected<void> find_ranges_inside(Scene& scene) {
  const auto unknown = [&](const View& view) { return view.far_depth == 0.0 && stands_in(view, scene.bounds); };
  if (std::ranges::none_of(scene.views, unknown)) return {};
  QUORUM_ASSIGN(auto small, sweep_small(scene));
  find_depth_ranges(small);
  for (std::size_t view = 0; view < scene.views.size(); ++view)
    if (unknown(scene.views[view])) take_range(small.views[view], scene.views[view]);
  return {};
}

}  // namespace quorum
