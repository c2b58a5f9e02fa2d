#include "engine/volume/range_surface.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "engine/volume/cell.h"

namespace quorum {

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
