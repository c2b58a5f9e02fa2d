// Which planes a pixel tries, and which it takes. Twin: engine/depth/plane_moves.h.
#include "lib/vote.glsl"

const PlaneTrial kNoTrial = PlaneTrial(0.0, 0.0, 0.0, 0.0, 0);

PlaneTrial move_plane(PlaneMove move, PixelPlane best, PixelPlane other) {
  bool from_neighbor = move.offset_x != 0 || move.offset_y != 0;
  PixelPlane from = best;
  if (from_neighbor) from = other;
  if (from.inverse_depth == 0.0) return kNoTrial;
  if (from_neighbor ? from.taken_by == 0 : move.undoes != 0 && from.taken_by == move.undoes) return kNoTrial;
  precise float ahead = float(move.offset_x) * from.slope_x + float(move.offset_y) * from.slope_y;
  precise float inverse_depth = (from.inverse_depth - ahead) + move.inverse_depth;
  precise float slope_x = from.slope_x + move.slope_x;
  precise float slope_y = from.slope_y + move.slope_y;
  precise float depth_apart = inverse_depth - best.inverse_depth;
  precise float apart_x = slope_x - best.slope_x;
  precise float apart_y = slope_y - best.slope_y;
  bool is_near =
      abs(depth_apart) < move.near_depth && abs(apart_x) < move.near_slope && abs(apart_y) < move.near_slope;
  if (from_neighbor && best.inverse_depth != 0.0 && is_near) return kNoTrial;
  return PlaneTrial(inverse_depth, slope_x, slope_y, 0.0, 0);
}

bool may_take(PlaneTrial plane, InverseDepthRange range, float max_tilt) {
  precise float limit = max_tilt * plane.inverse_depth;
  return plane.inverse_depth >= range.farthest && plane.inverse_depth <= range.nearest && plane.slope_x >= -limit &&
         plane.slope_x <= limit && plane.slope_y >= -limit && plane.slope_y <= limit;
}

bool can_win(float ncc_sum, int votes, int left, float least_confidence, int min_votes, float threshold,
             float confidence_scale) {
  const float margin = 1e-5;
  precise float bound = ncc_sum + float(left);
  precise float most = confidence_of(bound, votes + left, threshold, confidence_scale) + (left > 0 ? margin : 0.0);
  return votes + left >= min_votes && most > least_confidence;
}

PixelPlane taken_plane(PlaneTrial trial, float threshold, float confidence_scale, int move) {
  precise float correlation = trial.ncc_sum * reciprocal(float(trial.votes));
  return PixelPlane(trial.inverse_depth, trial.slope_x, trial.slope_y, correlation,
                    confidence_of(trial.ncc_sum, trial.votes, threshold, confidence_scale), move);
}
