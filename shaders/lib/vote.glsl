// The vote (the paper, section 2.1). Twin: engine/depth/vote.h.
#ifndef QUORUM_VOTE_GLSL
#define QUORUM_VOTE_GLSL
#include "lib/exact.glsl"

float confidence_of(float ncc_sum, int votes, float threshold, float confidence_scale) {
  precise float confidence = (ncc_sum - float(votes) * threshold) * confidence_scale;
  return confidence;
}

PixelVote vote(PixelVote best, float ncc_sum, int votes, int plane, VoteParams rule) {
  precise float correlation = ncc_sum * reciprocal(float(votes > 0 ? votes : 1));
  bool better = votes >= rule.min_votes && correlation > best.correlation;
  if (!better) return best;
  return PixelVote(correlation, confidence_of(ncc_sum, votes, rule.threshold, rule.confidence_scale), plane);
}

#endif
