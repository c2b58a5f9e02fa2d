#include "engine/depth/first_planes.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "engine/depth/fit_planes.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

Grid<PlaneTrial> first_planes(const SweepTask& task, const Grid<PixelVote>& first_pass, SimdLevel simd) {
  if (task.outside.values.empty()) return fit_planes(first_pass, task.planes, simd);
  const auto outside_of = [&](int x, int y) -> const OutsidePlane& {
    return task.outside.at(std::min(x >> task.outside_halvings, task.outside.width - 1),
                           std::min(y >> task.outside_halvings, task.outside.height - 1));
  };
  const auto prefers_outside = [&](int x, int y) {
    const OutsidePlane& plane = outside_of(x, y);
    return plane.inverse_depth > 0.0F && plane.correlation > first_pass.at(x, y).correlation;
  };
  Grid<PixelVote> inside = first_pass;
  tbb::parallel_for(0, inside.height, [&](int y) {
    for (int x = 0; x < inside.width; ++x)
      if (prefers_outside(x, y)) inside.at(x, y) = kNoVote;
  });
  Grid<PlaneTrial> planes = fit_planes(inside, task.planes, simd);
  tbb::parallel_for(0, planes.height, [&](int y) {
    for (int x = 0; x < planes.width; ++x)
      if (prefers_outside(x, y)) planes.at(x, y) = {outside_of(x, y).inverse_depth, 0.0F, 0.0F, 0.0F, 0};
  });
  return planes;
}

}  // namespace quorum
