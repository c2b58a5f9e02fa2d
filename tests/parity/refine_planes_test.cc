#include "engine/depth/refine_planes.h"

#include "tests/parity/plane_input.h"

namespace quorum {
namespace {

class RefinePlanesParity : public ParityTest {
 protected:
  /// One move after trials of which some won, on the device and pixel by pixel.
  static void compare(const PlaneMove& move, bool ends_round, unsigned seed) {
    const int width = 67;
    const int height = 45;
    const SphereScene sphere = make_sphere_scene(4, width, height, true, seed);
    const SweepTask task = make_sphere_task(sphere, 1, {});
    const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
    const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
    std::mt19937 random(seed);
    Grid<PixelPlane> last = random_planes(random, task);
    Grid<PixelPlane> best = random_planes(random, task);
    Grid<PlaneTrial> trials(width, height, PlaneTrial{});
    for (std::size_t pixel = 0; pixel < trials.values.size(); ++pixel) {
      const PixelPlane plane = random_pixel_plane(random, task, pixel);
      if (random() % 2 == 0 && plane.inverse_depth != 0.0F)
        trials.values[pixel] = {plane.inverse_depth, plane.slope_x, plane.slope_y, 2.5F, 3};
    }
    const RefinePlanesParams params{.move = move,
                                    .width = width,
                                    .height = height,
                                    .tried = 3,
                                    .ends_round = ends_round ? 1 : 0,
                                    .max_tilt = task.max_tilt,
                                    .threshold = rule.threshold,
                                    .confidence_scale = rule.confidence_scale};
    const Buffer last_buffer = buffer_of(last.values);
    const Buffer best_buffer = buffer_of(best.values);
    const Buffer trial_buffer = buffer_of(trials.values);
    run(kernel("refine_planes"), {std::int64_t{width} * height}, params,
        {buffer_of(ranges.values), last_buffer, best_buffer, trial_buffer});

    const Grid<PixelPlane> before = last;
    std::int64_t tried = 0;
    std::int64_t changed = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const InverseDepthRange& range = ranges.at(x, y);
        if (range.farthest > range.nearest) continue;
        PlaneTrial& trial = trials.at(x, y);
        PixelPlane& plane = best.at(x, y);
        if (trial.inverse_depth != 0.0F) plane = taken_plane(trial, rule, 3);
        trial = PlaneTrial{};
        if (ends_round) {
          last.at(x, y) = plane;
          changed += plane.taken_by != 0 ? 1 : 0;
          plane.taken_by = 0;
          continue;
        }
        const int other_x = x + move.offset_x;
        const int other_y = y + move.offset_y;
        const PlaneTrial next =
            move_plane(move, plane, before.contains(other_x, other_y) ? before.at(other_x, other_y) : kNoPlane);
        if (next.inverse_depth == 0.0F || !may_take(next, range, task.max_tilt)) continue;
        trial = next;
        ++tried;
      }
    }
    const std::string what = fmt::format("move ({}, {}) {} seed {}", move.offset_x, move.offset_y, ends_round, seed);
    ASSERT_TRUE(same_words(content<PixelPlane>(best_buffer), best.values, width, what + " best"));
    ASSERT_TRUE(same_words(content<PixelPlane>(last_buffer), last.values, width, what + " last"));
    ASSERT_TRUE(same_words(content<PlaneTrial>(trial_buffer), trials.values, width, what + " trials"));
    expect_share(ends_round ? changed : tried, std::int64_t{width} * height, 0.02, 0.9, what);
  }
};

TEST_F(RefinePlanesParity, EveryMoveGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const PlaneMove& move : {PlaneMove{-1, 0, 0, 0, 0, 0, 0, 0}, PlaneMove{0, 3, 0, 0, 0, 0.02F, 5e-3F, 0},
                                PlaneMove{0, 0, 1e-3F, 0, 0, 0, 0, 0}, PlaneMove{0, 0, 0, -1e-4F, 0, 0, 0, 3},
                                PlaneMove{0, 0, 0, 0, 1e-4F, 0, 0, 1}})
    compare(move, false, seed++);
  compare({}, true, seed);
}

}  // namespace
}  // namespace quorum
