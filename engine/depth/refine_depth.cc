#include "engine/depth/refine_depth.h"

#include <algorithm>

namespace quorum {

Grid<PlaneRange> refine_ranges(const Grid<PixelVote>& votes, const DepthPlanes& planes) {
  const int last_plane = static_cast<int>(planes.depth.size()) - 1;
  Grid<PlaneRange> ranges(votes.width, votes.height, PlaneRange{1, 0});
  for (std::size_t pixel = 0; pixel < votes.values.size(); ++pixel) {
    const int best = votes.values[pixel].plane;
    if (best < 0) continue;
    ranges.values[pixel] = {static_cast<uint>(std::max(best - planes.refinement + 1, 0)),
                            static_cast<uint>(std::min(best + planes.refinement - 1, last_plane))};
  }
  return ranges;
}

}  // namespace quorum
