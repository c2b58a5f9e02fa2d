#include "engine/volume/range_surface.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/volume/plane_edges.h"

namespace quorum {

RangeSurfaceParams make_range_surface_params(const Camera& camera, int width, int height,
                                             const FusionOptions& options) {
  constexpr double kPlaneSlopeDeg = 40;  // from which on planes are asked
  const Eigen::Matrix3d& k = camera.intrinsics;
  const double focal = (k(0, 0) + k(1, 1)) / 2.0;
  const auto step = [focal](double degrees) {
    return static_cast<float>(std::tan(degrees * std::numbers::pi / 180.0) / focal);
  };
  return {width,
          height,
          step(options.max_slope_deg),
          step(std::min(kPlaneSlopeDeg, options.max_slope_deg)),
          static_cast<float>(options.plane_agreement / focal),
          static_cast<float>(1.0 / k(0, 0)),
          static_cast<float>(1.0 / k(1, 1)),
          static_cast<float>(k(0, 2)),
          static_cast<float>(k(1, 2))};
}

Grid<std::uint32_t> pack_normals(const Grid<Eigen::Vector3f>& normals) {
  Grid<std::uint32_t> packed(normals.width, normals.height);
  for (std::size_t pixel = 0; pixel < normals.values.size(); ++pixel) {
    const Eigen::Vector3f& normal = normals.values[pixel];
    if (normal.isZero(0)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const float part = std::clamp(normal[axis], -1.0F, 1.0F) * static_cast<float>(kNormalScale);
      packed.values[pixel] |= static_cast<std::uint32_t>(std::lround(part) + kNormalZero) << (axis * kNormalBits);
    }
  }
  return packed;
}

Grid<std::uint32_t> range_surface(const Grid<float>& depth, const RangeSurfaceParams& params,
                                  const Grid<std::uint32_t>& normals) {
  RangeSurfaceParams rule = params;
  if (normals.empty()) rule.agreement = 0;
  const auto pixel_at = [&](int x, int y) {
    return SurfacePixel{static_cast<float>(x), static_cast<float>(y), depth.at(x, y),
                        normals.empty() ? 0U : normals.at(x, y)};
  };
  Grid<std::uint32_t> cells(params.width, params.height);
  tbb::parallel_for(0, params.height - 1, [&](int y) {
    for (int x = 0; x < params.width - 1; ++x) {
      const SurfacePixel p0 = pixel_at(x, y);
      const SurfacePixel p1 = pixel_at(x + 1, y);
      const SurfacePixel p2 = pixel_at(x, y + 1);
      const SurfacePixel p3 = pixel_at(x + 1, y + 1);
      const bool split_03 = is_split_03(p0.depth, p1.depth, p2.depth, p3.depth);
      const bool diagonal =
          split_03 ? joined_on_planes(p0, p3, kDiagonal, rule) : joined_on_planes(p1, p2, kDiagonal, rule);
      cells.at(x, y) = cell_bits(split_03, joined_on_planes(p0, p1, 1, rule), joined_on_planes(p0, p2, 1, rule),
                                 joined_on_planes(p1, p3, 1, rule), joined_on_planes(p2, p3, 1, rule), diagonal);
    }
  });
  return cells;
}

}  // namespace quorum
