// The vote: which plane a pixel takes (the paper, section 2.1). Twin of shaders/vote_depth.comp.
#pragma once

#include "engine/core/exact.h"
#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "shaders/layout.h"

namespace quorum {

/// Parameters of the vote that all pixels share.
struct VoteRule {
  float threshold = 0.6F;
  int min_votes = 2;
  float confidence_scale = 1.0F;  ///< 1 / (||C|| (1 - threshold))
};

VoteRule make_vote_rule(const SweepOptions& options, int neighbor_count);

/// No plane so far.
constexpr PixelVote kNoVote{0.0F, 0.0F, -1};

/// The better of a pixel's best plane so far and this one. ncc_sum, votes: sum and count of the NCC values above the
/// threshold, added in the order of the neighbors. corr(d) and conf(d) as in the paper; of planes with equal corr(d)
/// the first stays. Twin: vote in shaders/lib/vote.glsl.
[[gnu::always_inline]] inline PixelVote vote(PixelVote best, float ncc_sum, int votes, int plane,
                                             const VoteRule& rule) {
  const float count = static_cast<float>(votes);
  const float correlation = ncc_sum * reciprocal(votes > 0 ? count : 1.0F);
  const float confidence = (ncc_sum - count * rule.threshold) * rule.confidence_scale;
  const bool better = votes >= rule.min_votes && correlation > best.correlation;
  return better ? PixelVote{correlation, confidence, plane} : best;
}

/// The depth map that the votes say.
DepthMap depth_map_from_votes(const Grid<PixelVote>& votes, const DepthPlanes& planes);

}  // namespace quorum
