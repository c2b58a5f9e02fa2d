#include "engine/depth/vote_depth.h"

#include <algorithm>

namespace quorum {

VoteRule make_vote_rule(const SweepOptions& options, int neighbor_count) {
  return {options.threshold, options.min_votes,
          static_cast<float>(1.0 / (neighbor_count * (1.0 - static_cast<double>(options.threshold))))};
}

DepthMap depth_map_from_votes(const Grid<PixelVote>& votes, const DepthPlanes& planes) {
  DepthMap map{Grid<float>(votes.width, votes.height),
               Grid<float>(votes.width, votes.height),
               Grid<float>(votes.width, votes.height),
               {}};
  for (std::size_t pixel = 0; pixel < votes.values.size(); ++pixel) {
    const PixelVote& best = votes.values[pixel];
    if (best.plane < 0) continue;
    map.depth.values[pixel] = planes.depth[static_cast<std::size_t>(best.plane)];
    map.correlation.values[pixel] = best.correlation;
    map.confidence.values[pixel] = std::min(best.confidence, 1.0F);
  }
  return map;
}

}  // namespace quorum
