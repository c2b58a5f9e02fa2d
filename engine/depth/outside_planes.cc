#include "engine/depth/outside_planes.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/depth/small_task.h"
#include "engine/scene/ray_box.h"

namespace quorum {
namespace {

/// Planes from the nearest of the task to infinity, equally spaced in inverse depth.
DepthPlanes coarse_planes(const DepthPlanes& planes) {
  constexpr double kMostSteps = 512.0;
  const double nearest = planes.inverse_depth.front();
  constexpr double kSteps = 1 << kOutsideHalvings;
  const double step = std::max(kSteps * static_cast<double>(planes.step()), nearest / kMostSteps);
  DepthPlanes coarse;
  const auto add = [&coarse](double inverse_depth) {
    coarse.inverse_depth.push_back(static_cast<float>(inverse_depth));
    coarse.depth.push_back(static_cast<float>(1.0 / inverse_depth));
  };
  constexpr double kAlmostInfinite = 1.0 / 64.0;  // of a step: an eighth of a pixel of the photograph
  const auto count = static_cast<int>(std::ceil(nearest / step - kAlmostInfinite));
  for (int k = 0; k < count; ++k) add(nearest - k * step);
  add(kAlmostInfinite * step);
  return coarse;
}

/// Which pixels of the small image have one that is swept.
Grid<std::uint8_t> swept_pixels(const Grid<PlaneRange>& ranges, int width, int height) {
  Grid<std::uint8_t> swept(width, height);
  for (int y = 0; y < height << kOutsideHalvings; ++y)
    for (int x = 0; x < width << kOutsideHalvings; ++x)
      if (const PlaneRange& range = ranges.at(x, y); range.first <= range.last)
        swept.at(x >> kOutsideHalvings, y >> kOutsideHalvings) = 1;
  return swept;
}

}  // namespace

SweepTask make_outside_task(const SweepTask& task, const View& reference, const std::vector<const View*>& neighbors,
                            const Bounds& bounds, SmallImages& images) {
  SweepTask coarse = make_small_task(task, reference, neighbors, kOutsideHalvings, images);
  coarse.options.window_model = WindowModel::kPlane;
  coarse.options.window = 5;
  coarse.options.refinement = 1;
  coarse.options.min_votes = 1;  // what is far moves out of the images: often one neighbor alone shows it
  coarse.planes = coarse_planes(task.planes);
  const Camera camera = small_camera(reference.camera, kOutsideHalvings);

  const int width = coarse.reference->width;
  const int height = coarse.reference->height;
  const Grid<std::uint8_t> swept = swept_pixels(task.ranges, width, height);
  coarse.ranges = Grid<PlaneRange>(width, height, PlaneRange{1, 0});
  const Eigen::Vector3d origin = camera.center();
  const Eigen::Matrix3d world_from_pixel = camera.camera_from_world.transpose() * camera.intrinsics.inverse();
  const auto last = static_cast<uint>(coarse.planes.depth.size() - 1);
  const int radius = coarse.options.window / 2;
  tbb::parallel_for(radius, std::max(height - radius, radius), [&](int y) {
    for (int x = radius; x < width - radius; ++x) {
      if (swept.at(x, y) == 0) continue;
      const RaySpan span = ray_in_box(origin, world_from_pixel * Eigen::Vector3d(x, y, 1.0), bounds);
      const auto begin = std::ranges::upper_bound(coarse.planes.depth, span.enter);
      const auto first = begin == coarse.planes.depth.begin() ? begin : begin - 1;
      coarse.ranges.at(x, y) = {static_cast<uint>(first - coarse.planes.depth.begin()), last};
    }
  });
  return coarse;
}

Grid<OutsidePlane> outside_planes(const SweepTask& coarse, const DepthMap& map, const View& reference,
                                  const Bounds& bounds) {
  const Camera camera = small_camera(reference.camera, kOutsideHalvings);
  const Eigen::Vector3d origin = camera.center();
  const Eigen::Matrix3d world_from_pixel = camera.camera_from_world.transpose() * camera.intrinsics.inverse();
  const double step = coarse.planes.step();
  Grid<OutsidePlane> outside(map.depth.width, map.depth.height);
  tbb::parallel_for(0, outside.height, [&](int y) {
    for (int x = 0; x < outside.width; ++x) {
      const double depth = map.depth.at(x, y);
      if (depth <= 0.0) continue;
      const RaySpan span = ray_in_box(origin, world_from_pixel * Eigen::Vector3d(x, y, 1.0), bounds);
      if (!span.empty() && 1.0 / depth >= 1.0 / span.leave - step) continue;
      outside.at(x, y) = {static_cast<float>(1.0 / depth), map.correlation.at(x, y)};
    }
  });
  return outside;
}

}  // namespace quorum
