// Scores of tilted planes, many at a time: NCC of the support of each against every neighbor, and its votes. Planes
// that can't win any more are dropped after the neighbor that showed it.
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/grid.h"
#include "engine/depth/sweep_depth.h"
#include "engine/depth/sweep_task.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

/// What scoring needs of a view.
struct PlaneScorer {
  const SweepTask& task;
  const Grid<SupportWindow>& windows;
  VoteRule rule;
  SimdLevel simd;
};

/// Planes to score, each at a reference pixel whose window lies in the image. After score_planes: those that had the
/// votes and exceeded their least confidence, in the order in which they came.
struct PlaneBatch {
  static constexpr int kCapacity = 256;
  int count = 0;
  std::array<std::int32_t, kCapacity> x;
  std::array<std::int32_t, kCapacity> y;
  std::array<float, kCapacity> inverse_depth;
  std::array<float, kCapacity> slope_x;
  std::array<float, kCapacity> slope_y;
  std::array<float, kCapacity> least_confidence;  ///< that the plane must exceed
  std::array<float, kCapacity> ncc_sum;           ///< of the neighbors that vote for it
  std::array<std::int32_t, kCapacity> votes;

  void add(int pixel_x, int pixel_y, const PlaneTrial& plane, float least) {
    const auto i = static_cast<std::size_t>(count++);
    x[i] = pixel_x;
    y[i] = pixel_y;
    inverse_depth[i] = plane.inverse_depth;
    slope_x[i] = plane.slope_x;
    slope_y[i] = plane.slope_y;
    least_confidence[i] = least;
  }
  [[nodiscard]] bool full() const { return count == kCapacity; }
};

/// The confidence that ncc_sum and votes say, not cut at 1. Same operations as vote().
[[gnu::always_inline]] inline float confidence_of(float ncc_sum, int votes, const VoteRule& rule) {
  return (ncc_sum - static_cast<float>(votes) * rule.threshold) * rule.confidence_scale;
}

/// False if a plane can no longer exceed the least confidence with the votes, whatever the neighbors that are left say.
/// With none left: true if it does. The margin keeps rounding out of it. Twin: can_win in shaders/lib/plane_moves.glsl.
[[gnu::always_inline]] inline bool can_win(float ncc_sum, int votes, int left, float least_confidence,
                                           const VoteRule& rule) {
  constexpr float kMargin = 1e-5F;
  const float most = confidence_of(ncc_sum + static_cast<float>(left), votes + left, rule);
  return votes + left >= rule.min_votes && most + (left > 0 ? kMargin : 0.0F) > least_confidence;
}

/// The plane that a pixel takes from a trial that won. move: number of the one that made it.
/// Twin: taken_plane in shaders/lib/plane_moves.glsl.
[[gnu::always_inline]] inline PixelPlane taken_plane(const PlaneTrial& trial, const VoteRule& rule, int move) {
  return {trial.inverse_depth,
          trial.slope_x,
          trial.slope_y,
          trial.ncc_sum * reciprocal(static_cast<float>(trial.votes)),
          confidence_of(trial.ncc_sum, trial.votes, rule),
          move};
}

/// NCC of the support around reference pixel (x, y) on a plane against one neighbor; kNoNcc where the neighbor does not
/// see the whole window. One at a time: what score_planes and the kernel must equal.
float plane_ncc(const SweepTask& task, const SupportWindow& support, int neighbor, int x, int y,
                const PlaneTrial& plane);

/// Scores all planes of a batch, neighbors in their order, and keeps the winners. samples: grows by the number of
/// samples that were interpolated. Equal bytes at every SIMD level. Twin of shaders/score_planes.comp.
void score_planes(const PlaneScorer& scorer, PlaneBatch& batch, std::uint64_t& samples);

}  // namespace quorum
