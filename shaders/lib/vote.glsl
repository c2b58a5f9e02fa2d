// The vote (the paper, section 2.1). Twin: engine/depth/vote_depth.h.
#include "lib/exact.glsl"

PixelVote vote(PixelVote best, float ncc_sum, int votes, int plane, VoteParams rule) {
  float count = float(votes);
  precise float correlation = ncc_sum * reciprocal(votes > 0 ? count : 1.0);
  precise float confidence = (ncc_sum - count * rule.threshold) * rule.confidence_scale;
  bool better = votes >= rule.min_votes && correlation > best.correlation;
  if (better) return PixelVote(correlation, confidence, plane);
  return best;
}
