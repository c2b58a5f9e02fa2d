#include "engine/volume/range_surface.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace quorum {
namespace {

constexpr float kDiagonal = 1.41421356F;

/// Twin: cell_triangles in shaders/lib/cell.glsl.
std::uint32_t cell_triangles(float d0, float d1, float d2, float d3, float max_step) {
  const bool has_12 = d1 > 0.0F && d2 > 0.0F;
  const bool has_03 = d0 > 0.0F && d3 > 0.0F;
  const float step_12 = d1 < d2 ? d2 - d1 : d1 - d2;
  const float step_03 = d0 < d3 ? d3 - d0 : d0 - d3;
  const bool split_03 = has_03 && (!has_12 || step_03 < step_12);
  const bool top = joined(d0, d1, max_step, 1.0F);
  const bool left = joined(d0, d2, max_step, 1.0F);
  const bool right = joined(d1, d3, max_step, 1.0F);
  const bool bottom = joined(d2, d3, max_step, 1.0F);
  const bool diagonal = split_03 ? joined(d0, d3, max_step, kDiagonal) : joined(d1, d2, max_step, kDiagonal);
  const bool first = diagonal && top && (split_03 ? right : left);
  const bool second = diagonal && bottom && (split_03 ? left : right);
  return (first ? kCellFirstTriangle : 0U) | (second ? kCellSecondTriangle : 0U) |
         (split_03 && (first || second) ? kCellSplitAlong03 : 0U);
}

}  // namespace

RangeSurfaceParams make_range_surface_params(const Camera& camera, int width, int height,
                                             const FusionOptions& options) {
  const double focal = (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)) / 2.0;
  const double slope = std::tan(options.max_slope_deg * std::numbers::pi / 180.0);
  return {width, height, static_cast<float>(slope / focal)};
}

Grid<std::uint32_t> range_surface(const Grid<float>& depth, const RangeSurfaceParams& params) {
  Grid<std::uint32_t> cells(params.width, params.height);
  tbb::parallel_for(0, params.height - 1, [&](int y) {
    for (int x = 0; x < params.width - 1; ++x)
      cells.at(x, y) = cell_triangles(depth.at(x, y), depth.at(x + 1, y), depth.at(x, y + 1), depth.at(x + 1, y + 1),
                                      params.max_step);
  });
  return cells;
}

}  // namespace quorum
