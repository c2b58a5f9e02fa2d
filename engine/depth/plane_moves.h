// Which planes a pixel tries, and which it may take. Twin: shaders/lib/plane_moves.glsl.
#pragma once

#include <cmath>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/depth/sweep_task.h"
#include "engine/depth/vote.h"
#include "shaders/layout.h"

namespace quorum {

/// No plane.
constexpr PixelPlane kNoPlane{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0};

/// The moves of all rounds, in their order. A round tries the planes of the pixels at distance 1, and of those at 8, 5
/// or 3 from round to round, then a step either way in depth and in both slopes. Steps begin with half a step of the
/// first pass, and slopes with what moves the windows' borders by as much; they halve from round to round. A neighbor's
/// plane within these steps of the pixel's own is not tried: the steps search there. window: side, pixels.
std::vector<std::vector<PlaneMove>> plane_rounds(const DepthPlanes& planes, int window);

/// Where the planes of a pixel may cross its ray: in the bounds, and up to infinity if task.outside is not empty.
Grid<InverseDepthRange> inverse_depth_ranges(const SweepTask& task);

/// The steepest slope that a plane may have, as a share of its inverse depth: 80 degrees between the plane and the
/// image.
float max_plane_tilt(const Camera& camera);

/// The plane that a move tries at a pixel. best: the pixel's best plane so far. other: the plane of the last round at
/// the offset. Nothing if there is no such plane, if it did not change since it was tried, if it is near the best one,
/// or if the step would only take back the one before. Without branches, for vectors.
[[gnu::always_inline]] inline PlaneTrial move_plane(const PlaneMove& move, const PixelPlane& best,
                                                    const PixelPlane& other) {
  const bool from_neighbor = (move.offset_x != 0) | (move.offset_y != 0);
  const PixelPlane from = from_neighbor ? other : best;
  const float ahead =
      static_cast<float>(move.offset_x) * from.slope_x + static_cast<float>(move.offset_y) * from.slope_y;
  const PlaneTrial trial{(from.inverse_depth - ahead) + move.inverse_depth, from.slope_x + move.slope_x,
                         from.slope_y + move.slope_y, 0.0F, 0};
  const float apart = std::abs(trial.inverse_depth - best.inverse_depth);
  const float apart_x = std::abs(trial.slope_x - best.slope_x);
  const float apart_y = std::abs(trial.slope_y - best.slope_y);
  const bool is_near = (apart < move.near_depth) & (apart_x < move.near_slope) & (apart_y < move.near_slope);
  const bool unchanged = from_neighbor ? from.taken_by == 0 : (move.undoes != 0) & (from.taken_by == move.undoes);
  const bool is_none =
      (from.inverse_depth == 0.0F) | unchanged | (from_neighbor & (best.inverse_depth != 0.0F) & is_near);
  return {kept_if(!is_none, trial.inverse_depth), kept_if(!is_none, trial.slope_x), kept_if(!is_none, trial.slope_y),
          0.0F, 0};
}

/// True if a pixel with this range may take the plane.
[[gnu::always_inline]] inline bool may_take(const PlaneTrial& plane, const InverseDepthRange& range, float max_tilt) {
  const float limit = max_tilt * plane.inverse_depth;
  return (plane.inverse_depth >= range.farthest) & (plane.inverse_depth <= range.nearest) & (plane.slope_x >= -limit) &
         (plane.slope_x <= limit) & (plane.slope_y >= -limit) & (plane.slope_y <= limit);
}

/// False if a plane can no longer exceed the least confidence with the votes, whatever the neighbors that are left say.
/// With none left: true if it does. The margin keeps rounding out of it.
[[gnu::always_inline]] inline bool can_win(float ncc_sum, int votes, int left, float least_confidence,
                                           const VoteRule& rule) {
  constexpr float kMargin = 1e-5F;
  const float most = confidence_of(ncc_sum + static_cast<float>(left), votes + left, rule);
  return (votes + left >= rule.min_votes) & (most + (left > 0 ? kMargin : 0.0F) > least_confidence);
}

/// The plane that a pixel takes from a trial that won. move: number of the one that made it.
[[gnu::always_inline]] inline PixelPlane taken_plane(const PlaneTrial& trial, const VoteRule& rule, int move) {
  return {trial.inverse_depth,
          trial.slope_x,
          trial.slope_y,
          trial.ncc_sum * reciprocal(static_cast<float>(trial.votes)),
          confidence_of(trial.ncc_sum, trial.votes, rule),
          move};
}

}  // namespace quorum
