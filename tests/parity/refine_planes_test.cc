#include "engine/depth/refine_planes.h"

#include "engine/depth/support_windows.h"
#include "tests/parity/plane_input.h"

namespace quorum {
namespace {

class RefinePlanesParity : public ParityTest {
 protected:
  /// One round, on the device and pixel by pixel. moves_at_once: of a dispatch.
  static void compare(const SweepTask& task, const Round& round, int moves_at_once, unsigned seed) {
    const int width = task.ranges.width;
    const int height = task.ranges.height;
    const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
    const int window = task.options.window;
    const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
    const Grid<SupportWindow> supports = make_support_windows(*task.reference, window, task.options.support_tolerance);
    std::mt19937 random(seed);
    const Grid<PixelPlane> last = random_planes(random, task);
    const std::vector<PixelPlane> untouched(last.values.size(), PixelPlane{7.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0});

    std::vector<Rgba> images = task.reference->pixels;
    std::vector<PlaneNeighbor> neighbors;
    for (std::size_t i = 0; i < task.neighbors.size(); ++i) {
      const PaddedImage& image = *task.neighbors[i];
      neighbors.push_back({task.warps[i], image.width, image.height, static_cast<int>(images.size()), 0});
      images.insert(images.end(), image.pixels.begin(), image.pixels.end());
    }
    const Kernel refine_planes =
        kernel("refine_planes", {{"kWindow", static_cast<std::uint32_t>(window)},
                                 {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}});
    const Buffer best = buffer_of(untouched);
    const int move_count = static_cast<int>(round.moves.size());
    for (int move = 0; move < move_count; move += moves_at_once) {
      const RefinePlanesParams params{.width = width,
                                      .height = height,
                                      .row_begin = round.row_begin,
                                      .row_end = round.row_end,
                                      .move_begin = move,
                                      .move_end = std::min(move + moves_at_once, move_count),
                                      .neighbor_count = task.neighbor_count(),
                                      .is_first = round.is_first ? 1 : 0,
                                      .min_votes = rule.min_votes,
                                      .max_tilt = task.max_tilt,
                                      .threshold = rule.threshold,
                                      .confidence_scale = rule.confidence_scale};
      run(refine_planes, {width, round.row_end - round.row_begin}, params,
          {buffer_of(round.moves), buffer_of(neighbors), buffer_of(ranges.values), buffer_of(supports.values),
           buffer_of(images), buffer_of(last.values), best});
    }

    std::vector<PixelPlane> twin = untouched;
    std::int64_t tried = 0;
    std::int64_t taken = 0;
    for (int y = round.row_begin; y < round.row_end; ++y) {
      for (int x = 0; x < width; ++x) {
        PixelPlane plane = round.is_first ? kNoPlane : last.at(x, y);
        plane.taken_by = 0;
        const InverseDepthRange& range = ranges.at(x, y);
        if (range.farthest <= range.nearest)
          tried += refine_pixel(task, supports, round, x, y, range, last, plane) ? 1 : 0;
        twin[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = plane;
        taken += plane.taken_by != 0 ? 1 : 0;
      }
    }
    const std::string what =
        fmt::format("window {} {} moves, {} at once, {}x{} rows {}..{} seed {}", window, move_count, moves_at_once,
                    width, height, round.row_begin, round.row_end, seed);
    ASSERT_TRUE(same_words(content<PixelPlane>(best), twin, width, what));
    const std::int64_t pixels_of_run = std::int64_t{width} * (round.row_end - round.row_begin);
    expect_share(tried, pixels_of_run, 0.02, 0.95, what + " tried");
    expect_share(taken, pixels_of_run, 0.005, 0.9, what + " taken");
  }
};

TEST_F(RefinePlanesParity, EveryWindowGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    const SweepTask task = make_planes_task(window, 30, window % 4 == 1, 67, 45, seed);
    const std::vector<PlaneMove> moves = plane_rounds(task.planes, window)[1];
    compare(task, {moves, false, 0, 45, 0}, 100, seed++);
    if (HasFailure()) return;
  }
}

TEST_F(RefinePlanesParity, TheFirstPlanesAreTriedAsTheyAre) {
  const SweepTask task = make_planes_task(5, 255, true, 67, 45, 5);
  compare(task, {{PlaneMove{}}, true, 0, 45, 0}, 1, 5);
}

TEST_F(RefinePlanesParity, MovesMayComeInSeveralDispatchesAndRowsToo) {
  const SweepTask task = make_planes_task(5, 30, false, 50, 61, 6);
  const std::vector<PlaneMove> moves = plane_rounds(task.planes, 5)[0];
  compare(task, {moves, false, 13, 14, 0}, 5, 6);
  compare(task, {moves, false, 24, 61, 0}, 1, 7);
}

}  // namespace
}  // namespace quorum
