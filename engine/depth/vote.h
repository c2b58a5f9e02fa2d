// The vote: which plane a pixel takes (the paper, section 2.1). Twin: shaders/lib/vote.glsl.
#pragma once

#include "engine/core/exact.h"
#include "shaders/layout.h"

namespace quorum {

/// Parameters of the vote that all pixels share.
struct VoteRule {
  float threshold = 0.6F;
  int min_votes = 2;
  float confidence_scale = 1.0F;  ///< 1 / (||C|| (1 - threshold))
};

/// conf(d) of the paper, not cut at 1. ncc_sum, votes: sum and count of the NCC values above the threshold, added in
/// the order of the neighbors.
[[gnu::always_inline]] inline float confidence_of(float ncc_sum, int votes, const VoteRule& rule) {
  return (ncc_sum - static_cast<float>(votes) * rule.threshold) * rule.confidence_scale;
}

/// The better of a pixel's best plane so far and this one. ncc_sum, votes: as for confidence_of. corr(d) as in the
/// paper; of planes with equal corr(d) the first stays.
[[gnu::always_inline]] inline PixelVote vote(PixelVote best, float ncc_sum, int votes, int plane,
                                             const VoteRule& rule) {
  const float correlation = ncc_sum * reciprocal(static_cast<float>(votes > 0 ? votes : 1));
  const bool better = votes >= rule.min_votes && correlation > best.correlation;
  return better ? PixelVote{correlation, confidence_of(ncc_sum, votes, rule), plane} : best;
}

}  // namespace quorum
