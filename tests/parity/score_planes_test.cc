#include "engine/depth/support_windows.h"
#include "tests/parity/plane_input.h"

namespace quorum {
namespace {

class ScorePlanesParity : public ParityTest {
 protected:
  /// The trials of a view after each neighbor, on the device and window by window.
  static void compare(int window, int tolerance, bool flip, int width, int height, unsigned seed) {
    SweepOptions options;
    options.window = window;
    options.threshold = 0.4F;
    const SphereScene sphere = make_sphere_scene(4, width, height, flip, seed);
    const SweepTask task = make_sphere_task(sphere, 1, options);
    const VoteRule rule = make_vote_rule(options, task.neighbor_count());
    std::mt19937 random(seed);
    Grid<PixelPlane> best(width, height, kNoPlane);
    std::vector<PlaneTrial> twin(best.values.size(), PlaneTrial{});
    for (std::size_t pixel = 0; pixel < twin.size(); ++pixel) {
      const PixelPlane plane = random_pixel_plane(random, task, pixel);
      twin[pixel] = {plane.inverse_depth, plane.slope_x, plane.slope_y, 0.0F, 0};
      if (random() % 4 == 0) best.values[pixel].confidence = 0.3F;
    }
    const Kernel score_planes =
        kernel("score_planes", {{"kWindow", static_cast<std::uint32_t>(window)},
                                {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}});
    const Buffer reference = buffer_of(task.reference->pixels);
    const Grid<SupportWindow> supports = make_support_windows(*task.reference, window, tolerance);
    const Buffer windows = buffer_of(supports.values);
    const Buffer best_buffer = buffer_of(best.values);
    const Buffer trials = buffer_of(twin);
    std::int64_t alive = 0;
    std::int64_t votes = 0;
    for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
      const auto index = static_cast<std::size_t>(neighbor);
      const int left = task.neighbor_count() - 1 - neighbor;
      const ScorePlanesParams params{.warp = task.warps[index],
                                     .width = width,
                                     .height = height,
                                     .neighbor_width = task.neighbors[index]->width,
                                     .neighbor_height = task.neighbors[index]->height,
                                     .left = left,
                                     .min_votes = rule.min_votes,
                                     .threshold = rule.threshold,
                                     .confidence_scale = rule.confidence_scale};
      run(score_planes, {std::int64_t{width} * height}, params,
          {reference, windows, buffer_of(task.neighbors[index]->pixels), best_buffer, trials});
      alive = 0;
      for (std::size_t pixel = 0; pixel < twin.size(); ++pixel) {
        PlaneTrial& trial = twin[pixel];
        if (trial.inverse_depth == 0.0F) continue;
        const float ncc = plane_ncc(task, supports.values[pixel], neighbor, static_cast<int>(pixel) % width,
                                    static_cast<int>(pixel) / width, trial);
        if (ncc > rule.threshold) {
          trial.ncc_sum += ncc;
          ++trial.votes;
          ++votes;
        }
        if (!can_win(trial.ncc_sum, trial.votes, left, best.values[pixel].confidence, rule)) trial = PlaneTrial{};
        alive += trial.inverse_depth != 0.0F ? 1 : 0;
      }
      const std::string what = fmt::format("window {} tolerance {} {}x{} flip {} seed {} neighbor {}", window,
                                           tolerance, width, height, flip, seed, neighbor);
      ASSERT_TRUE(same_words(content<PlaneTrial>(trials), twin, width, what));
    }
    expect_share(alive, std::int64_t{width} * height, 0.002, 0.9, "trials that win");
    expect_share(votes, std::int64_t{width} * height, 0.01, 3.0, "votes");
  }
};

TEST_F(ScorePlanesParity, EveryWindowGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    compare(window, 30, true, 67, 45, seed++);
    compare(window, 255, false, 131, 61, seed++);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace quorum
