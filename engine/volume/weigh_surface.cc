#include "engine/volume/weigh_surface.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "engine/core/exact.h"
#include "engine/volume/cell.h"

namespace quorum {
namespace {

constexpr std::uint32_t kBothTriangles = kCellFirstTriangle | kCellSecondTriangle;

/// Cell at (x, y); none outside the image.
std::uint32_t cell_at(const Grid<std::uint32_t>& cells, int x, int y) {
  return cells.contains(x, y) ? cells.at(x, y) : 0U;
}

/// True if some triangle has the pixel as a corner. Twin: on_surface in shaders/weigh_surface.comp.
bool on_surface(const Grid<std::uint32_t>& cells, int x, int y) {
  const auto has = [&](int cell_x, int cell_y, std::uint32_t when_12, std::uint32_t when_03) {
    const std::uint32_t cell = cell_at(cells, cell_x, cell_y);
    return (cell & ((cell & kCellSplitAlong03) != 0 ? when_03 : when_12)) != 0;
  };
  return has(x, y, kCellFirstTriangle, kBothTriangles) || has(x - 1, y, kBothTriangles, kCellFirstTriangle) ||
         has(x, y - 1, kBothTriangles, kCellSecondTriangle) || has(x - 1, y - 1, kCellSecondTriangle, kBothTriangles);
}

/// Pixels from (x, y) to the nearest vertex at a cell that misses a triangle, at most feather.
int border_distance(const Grid<std::uint32_t>& cells, int x, int y, int feather) {
  int nearest = feather;
  for (int dy = -feather; dy < feather; ++dy) {
    for (int dx = -feather; dx < feather; ++dx) {
      if ((cell_at(cells, x + dx, y + dy) & kBothTriangles) == kBothTriangles) continue;
      nearest = std::min(nearest, std::max(dx >= 0 ? dx : -dx - 1, dy >= 0 ? dy : -dy - 1));
    }
  }
  return nearest;
}

/// Change of depth per pixel between the neighbors on either side, as far as the surface goes on there.
/// Twin: slope in shaders/weigh_surface.comp.
float slope(float before, float here, float after, float max_step) {
  const bool has_before = joined(before, here, max_step, 1.0F);
  const bool has_after = joined(here, after, max_step, 1.0F);
  const float from = has_before ? before : here;
  const float to = has_after ? after : here;
  return (to - from) * (has_before && has_after ? 0.5F : 1.0F);
}

}  // namespace

WeighSurfaceParams make_weigh_surface_params(const Camera& camera, int width, int height,
                                             const FusionOptions& options) {
  const Eigen::Matrix3d& k = camera.intrinsics;
  return {width,
          height,
          static_cast<float>(k(0, 0)),
          static_cast<float>(k(1, 1)),
          static_cast<float>(k(0, 2)),
          static_cast<float>(k(1, 2)),
          make_range_surface_params(camera, width, height, options).max_step,
          options.feather,
          (options.signed_distance == SignedDistance::kNormal ? kDistanceAlongNormal : 0U) |
              (options.weigh_confidence ? kWeighConfidence : 0U) | (options.weigh_slant ? kWeighSlant : 0U) |
              (options.weigh_border ? kWeighBorder : 0U)};
}

Grid<std::uint32_t> weigh_surface(const Grid<float>& depth, const Grid<float>& confidence,
                                  const Grid<std::uint32_t>& cells, const WeighSurfaceParams& params) {
  const float inverse_focal_x = reciprocal(params.focal_x);
  const float inverse_focal_y = reciprocal(params.focal_y);
  const float feather_scale = reciprocal(static_cast<float>(params.feather + 1));
  const auto depth_at = [&](int x, int y) { return depth.contains(x, y) ? depth.at(x, y) : 0.0F; };
  Grid<std::uint32_t> weights(params.width, params.height);
  tbb::parallel_for(0, params.height, [&](int y) {
    for (int x = 0; x < params.width; ++x) {
      if (!on_surface(cells, x, y)) continue;
      // With depth d(x, y) and ray r = ((x - cx) / fx, (y - cy) / fy, 1), the normal is (-gx, -gy, d + gx rx + gy ry)
      // for gx = fx ∂d/∂x, gy = fy ∂d/∂y, and its product with r is d.
      const float d = depth.at(x, y);
      const float gx = params.focal_x * slope(depth_at(x - 1, y), d, depth_at(x + 1, y), params.max_step);
      const float gy = params.focal_y * slope(depth_at(x, y - 1), d, depth_at(x, y + 1), params.max_step);
      const float rx = (static_cast<float>(x) - params.principal_x) * inverse_focal_x;
      const float ry = (static_cast<float>(y) - params.principal_y) * inverse_focal_y;
      const float nz = d + (gx * rx + gy * ry);
      const float normal_squared = gx * gx + (gy * gy + nz * nz);
      const float ray_squared = rx * rx + (ry * ry + 1.0F);
      const float cosine = (d * reciprocal_sqrt(normal_squared)) * reciprocal_sqrt(ray_squared);
      const float ramp = static_cast<float>(border_distance(cells, x, y, params.feather) + 1) * feather_scale;
      const float confidence_factor = (params.factors & kWeighConfidence) != 0 ? confidence.at(x, y) : 1.0F;
      const float slant_factor = (params.factors & kWeighSlant) != 0 ? cosine : 1.0F;
      const float border_factor = (params.factors & kWeighBorder) != 0 ? ramp * ramp : 1.0F;
      const float weight =
          ((confidence_factor * slant_factor) * border_factor) * static_cast<float>(kWeightScale) + 0.5F;
      const float distance_factor = (params.factors & kDistanceAlongNormal) != 0 ? cosine : 1.0F;
      const float scaled_cosine = distance_factor * static_cast<float>(kCosineScale) + 0.5F;
      const int cosine_bits = std::clamp(static_cast<int>(scaled_cosine), 1, kCosineScale) << kWeightBits;
      weights.at(x, y) =
          static_cast<std::uint32_t>(std::clamp(static_cast<int>(weight), 1, kWeightScale) + cosine_bits);
    }
  });
  return weights;
}

}  // namespace quorum
