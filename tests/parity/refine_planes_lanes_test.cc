#include "engine/depth/refine_planes.h"
#include "engine/depth/support_windows.h"
#include "host/plane_lanes_stage.h"
#include "host/sweep_texels.h"
#include "tests/parity/plane_input.h"

namespace quorum {
namespace {

class RefinePlanesLanesParity : public ParityTest {
 protected:
  static PlaneTexel texel_of(const PixelPlane& plane) {
    return {plane.inverse_depth, plane.slope_x, plane.slope_y,
            plane.taken_by != 0 ? -plane.confidence : plane.confidence};
  }

  /// One round, on the device and pixel by pixel.
  static void compare(const SweepTask& task, const Round& round, unsigned seed) {
    const int width = task.ranges.width;
    const int height = task.ranges.height;
    const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
    const int window = task.options.window;
    const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
    const Grid<SupportWindow> supports = make_support_windows(*task.reference, window, task.options.support_tolerance);
    std::mt19937 random(seed);
    const Grid<PixelPlane> last = random_planes(random, task);

    std::vector<Texel> quads = make_quads(*task.reference);
    std::vector<PlaneNeighbor> neighbors;
    for (std::size_t i = 0; i < task.neighbors.size(); ++i) {
      const PaddedImage& image = *task.neighbors[i];
      neighbors.push_back({task.warps[i], image.width, image.height, static_cast<int>(quads.size()), 0});
      const std::vector<Texel> more = make_quads(image);
      quads.insert(quads.end(), more.begin(), more.end());
    }
    std::vector<PlanePixel> pixels;
    std::vector<PlaneTexel> planes;
    for (std::size_t i = 0; i < last.values.size(); ++i) {
      pixels.push_back({supports.values[i], ranges.values[i]});
      planes.push_back(texel_of(last.values[i]));
    }
    const Buffer result = buffer_of(planes);
    const std::vector<float> no_correlations(planes.size(), 0.5F);
    const Buffer correlations = buffer_of(no_correlations);
    const RefinePlanesLanesParams params{.width = width,
                                         .height = height,
                                         .row_begin = round.row_begin,
                                         .row_end = round.row_end,
                                         .rows_per_lane = round.rows_per_lane,
                                         .first_pixel = 0,
                                         .move_count = static_cast<int>(round.moves.size()),
                                         .neighbor_count = task.neighbor_count(),
                                         .is_first = round.is_first ? 1 : 0,
                                         .min_votes = rule.min_votes,
                                         .max_tilt = task.max_tilt,
                                         .threshold = rule.threshold,
                                         .confidence_scale = rule.confidence_scale};
    const int strips = (round.row_end - round.row_begin + round.rows_per_lane - 1) / round.rows_per_lane;
    run(kernel("refine_planes_lanes",
               {{"kWindow", static_cast<std::uint32_t>(window)},
                {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}}),
        {std::int64_t{8} * ((width + 7) / 8) * strips}, params,
        {buffer_of(round.moves), buffer_of(neighbors), buffer_of(pixels), buffer_of(quads), buffer_of(planes), result,
         correlations});

    std::vector<PlaneTexel> twin = planes;
    std::vector<float> twin_correlations = no_correlations;
    std::int64_t tried = 0;
    std::int64_t taken = 0;
    for (int y = round.row_begin; y < round.row_end; ++y) {
      for (int x = 0; x < width; ++x) {
        PixelPlane best = round.is_first ? kNoPlane : last.at(x, y);
        best.taken_by = 0;
        const InverseDepthRange& range = ranges.at(x, y);
        if (range.farthest <= range.nearest)
          tried += refine_pixel(task, supports, round, x, y, range, last, best) ? 1 : 0;
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        twin[pixel] = texel_of(best);
        if (best.taken_by != 0) twin_correlations[pixel] = best.correlation;
        taken += best.taken_by != 0 ? 1 : 0;
      }
    }
    const std::string what =
        fmt::format("window {} {} moves {}x{} rows {}..{} by {} seed {}", window, round.moves.size(), width, height,
                    round.row_begin, round.row_end, round.rows_per_lane, seed);
    ASSERT_TRUE(same_words(content<PlaneTexel>(result), twin, width, what));
    ASSERT_TRUE(same_words(content<float>(correlations), twin_correlations, width, what + " correlations"));
    const std::int64_t pixels_of_run = std::int64_t{width} * (round.row_end - round.row_begin);
    expect_share(tried, pixels_of_run, 0.02, 0.95, what + " tried");
    expect_share(taken, pixels_of_run, 0.005, 0.9, what + " taken");
  }
};

TEST_F(RefinePlanesLanesParity, EveryWindowGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    const SweepTask task = make_planes_task(window, 30, window % 4 == 1, 67, 45, seed);
    const std::vector<PlaneMove> moves = plane_rounds(task.planes, window)[1];
    compare(task, {moves, false, 0, 45, 32}, seed++);
    if (HasFailure()) return;
  }
}

TEST_F(RefinePlanesLanesParity, TheFirstPlanesAreTriedAsTheyAre) {
  const SweepTask task = make_planes_task(5, 255, true, 67, 45, 5);
  compare(task, {{PlaneMove{}}, true, 0, 45, 7}, 5);
}

TEST_F(RefinePlanesLanesParity, ARunWritesItsRowsAlone) {
  const SweepTask task = make_planes_task(5, 30, false, 50, 61, 6);
  const std::vector<PlaneMove> moves = plane_rounds(task.planes, 5)[0];
  compare(task, {moves, false, 13, 14, 1}, 6);
  compare(task, {moves, false, 20, 61, 6}, 7);
}

TEST_F(RefinePlanesLanesParity, TheStageGivesThePlanesOfTheTwinWhereKernelsSeeLittleOfABuffer) {
  const SweepTask task = make_planes_task(5, 15, true, 150, 101, 8);
  const CpuSweepOptions cpu;
  const Grid<PixelVote> first_pass = sweep_planes(task, task.ranges, task.planes.refinement, cpu);
  const Grid<PixelPlane> twin = refine_planes(task, first_pass, cpu);
  for (const std::uint64_t range : {std::uint64_t{0}, std::uint64_t{1} << 14}) {
    const Device limited =
        Device::open(device().info(), {.validation = true, .max_storage_buffer_range = range}).value();
    Commands commands = Commands::create(limited).value();
    PlaneLanesStage stage(commands);
    ASSERT_TRUE(stage.fits(task));
    Grid<PixelPlane> planes = stage.run(task, first_pass).value();
    for (const std::string& message : limited.take_validation_messages()) ADD_FAILURE() << message;
    ASSERT_TRUE(same_words(planes.values, twin.values, 150, fmt::format("range {}", range)));
  }
  const auto found = std::ranges::count_if(twin.values, [](const PixelPlane& p) { return p.inverse_depth > 0.0F; });
  expect_share(found, 150 * 101, 0.1, 0.9, "pixels with a plane");
}

}  // namespace
}  // namespace quorum
