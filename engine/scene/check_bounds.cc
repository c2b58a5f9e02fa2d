#include "engine/scene/check_bounds.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/option.h"
#include "engine/scene/ray_box.h"

namespace quorum {
namespace {

std::string format_point(const Eigen::Vector3d& point) {
  return fmt::format("({:.17g} {:.17g} {:.17g})", point.x(), point.y(), point.z());
}

/// True if the ray from a camera through a pixel meets the box.
bool ray_meets(const Camera& camera, double x, double y, const Bounds& bounds) {
  const Eigen::Vector3d origin = camera.center();
  return !ray_in_box(origin, camera.unproject(x, y, 1.0) - origin, bounds).empty();
}

/// Tries 27 points of the box, which finds a small one, and 25 rays of the view, which find a large one.
bool sees(const View& view, const Bounds& bounds) {
  for (int i = 0; i < 27; ++i) {
    const Eigen::Array3d fraction = Eigen::Array3d(i % 3, i / 3 % 3, i / 9) / 2.0;
    const Eigen::Vector3d pixel = view.camera.project(bounds.low.array() + fraction * bounds.size().array());
    if (pixel.z() > 0 && pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= view.width - 0.5 &&
        pixel.y() <= view.height - 0.5)
      return true;
  }
  for (int i = 0; i < 25; ++i)
    if (ray_meets(view.camera, (view.width - 1) * (i % 5) / 4.0, (view.height - 1) * (i / 5) / 4.0, bounds))
      return true;
  return false;
}

}  // namespace

Expected<void> check_bounds(const Scene& scene) {
  const std::string remedy = "give them with " + option_name("bounds") + " \"x0 y0 z0 x1 y1 z1\"";
  const Bounds& bounds = scene.bounds;
  const std::string text =
      "bounds " + format_point(bounds.low + scene.offset) + " " + format_point(bounds.high + scene.offset);
  if (!bounds.valid() || !bounds.low.allFinite() || !bounds.high.allFinite())
    return failure(ErrorKind::kInput,
                   fmt::format("{} are empty: each low coordinate must be below the high one; {}", text, remedy));
  if (std::ranges::none_of(scene.views, [&bounds](const View& view) { return sees(view, bounds); }))
    return failure(ErrorKind::kInput,
                   fmt::format("no view sees the {}; check their unit and frame, or {}", text, remedy));
  return {};
}

}  // namespace quorum
