// Scores of tilted planes, many at a time: NCC of the support of each against every neighbor, and its votes. Planes
// that can't win any more are dropped after the neighbor that showed it. Twin of what shaders/refine_planes.comp
// does with a trial.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/grid.h"
#include "engine/depth/sweep_depth.h"
#include "engine/depth/sweep_task.h"
#include "engine/depth/texel_columns.h"
#include "engine/depth/tile_supports.h"
#include "engine/depth/vote.h"

namespace quorum {

/// What scoring needs of a view.
struct PlaneScorer {
  const SweepTask& task;
  const Grid<SupportWindow>& windows;
  VoteRule rule;
  SimdLevel simd;
  std::vector<TexelColumns> neighbors;  ///< those of the task
};

/// windows: as make_support_windows gives them; they and the task must live longer.
PlaneScorer make_plane_scorer(const SweepTask& task, const Grid<SupportWindow>& windows, SimdLevel simd);

/// Planes to score, each at a reference pixel whose window lies in the image. After score_planes: those that had the
/// votes and exceeded their least confidence, in the order in which they came.
struct PlaneBatch {
  static constexpr int kCapacity = 128;
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

/// NCC of the support around reference pixel (x, y) on a plane against one neighbor; kNoNcc where the neighbor does not
/// see the whole window. One at a time: what score_planes and the kernel must equal.
float plane_ncc(const SweepTask& task, const SupportWindow& support, int neighbor, int x, int y,
                const PlaneTrial& plane);

/// Scores all planes of a batch, neighbors in their order, and keeps the winners. samples: grows by the number of
/// samples that were interpolated. supports: of a tile that has the planes' pixels. Equal bytes at every SIMD level.
void score_planes(const PlaneScorer& scorer, const TileSupports& supports, PlaneBatch& batch, std::uint64_t& samples);

}  // namespace quorum
