// Inputs of the kernels that refine planes.
#pragma once

#include <random>
#include <vector>

#include "engine/depth/plane_moves.h"
#include "engine/depth/score_planes.h"
#include "engine/depth/vote_depth.h"
#include "tests/parity/parity_test.h"
#include "tests/support/sphere_scene.h"

namespace quorum {

/// Planes near those of a fronto-parallel sweep; every fifth pixel has none.
inline PixelPlane random_pixel_plane(std::mt19937& random, const SweepTask& task, std::size_t pixel) {
  const PlaneRange& range = task.ranges.values[pixel];
  if (range.first > range.last || random() % 5 == 0) return kNoPlane;
  std::normal_distribution<float> noise(0.0F, 1.0F);
  const std::uint32_t plane = range.first + static_cast<std::uint32_t>(random()) % (range.last - range.first + 1);
  const float inverse_depth = task.planes.inverse_depth[plane];
  return {inverse_depth * (1.0F + 1e-3F * noise(random)),
          4e-3F * inverse_depth * noise(random),
          4e-3F * inverse_depth * noise(random),
          0.7F,
          std::uniform_real_distribution<float>(0.0F, 1.0F)(random),
          static_cast<int>(random() % 2)};
}

inline Grid<PixelPlane> random_planes(std::mt19937& random, const SweepTask& task) {
  Grid<PixelPlane> planes(task.ranges.width, task.ranges.height, kNoPlane);
  for (std::size_t pixel = 0; pixel < planes.values.size(); ++pixel)
    planes.values[pixel] = random_pixel_plane(random, task, pixel);
  return planes;
}

/// A round of moves at the rows of a run.
struct Round {
  std::vector<PlaneMove> moves;
  bool is_first = false;
  int row_begin = 0;
  int row_end = 0;
  int rows_per_lane = 1;
};

inline SweepTask make_planes_task(int window, int tolerance, bool flip, int width, int height, unsigned seed) {
  SweepOptions options;
  options.window = window;
  options.threshold = 0.4F;
  options.support_tolerance = tolerance;
  return make_sphere_task(make_sphere_scene(4, width, height, flip, seed), 1, options);
}

/// What a pixel takes from a round, window by window. True if it tried a plane.
inline bool refine_pixel(const SweepTask& task, const Grid<SupportWindow>& supports, const Round& round, int x, int y,
                         const InverseDepthRange& range, const Grid<PixelPlane>& last, PixelPlane& best) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  bool tried = false;
  int number = 0;
  for (const PlaneMove& move : round.moves) {
    ++number;
    const int other_x = x + move.offset_x;
    const int other_y = y + move.offset_y;
    const PixelPlane other = last.contains(other_x, other_y) ? last.at(other_x, other_y) : kNoPlane;
    PlaneTrial trial = round.is_first ? PlaneTrial{other.inverse_depth, other.slope_x, other.slope_y, 0.0F, 0}
                                      : move_plane(move, best, other);
    if (trial.inverse_depth == 0.0F || !may_take(trial, range, task.max_tilt)) continue;
    tried = true;
    for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
      const float ncc = plane_ncc(task, supports.at(x, y), neighbor, x, y, trial);
      if (!(ncc > rule.threshold)) continue;
      trial.ncc_sum += ncc;
      ++trial.votes;
    }
    if (can_win(trial.ncc_sum, trial.votes, 0, best.confidence, rule)) best = taken_plane(trial, rule, number);
  }
  return tried;
}

}  // namespace quorum
