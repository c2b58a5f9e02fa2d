#include "engine/depth/first_planes.h"

#include "engine/depth/fit_planes.h"
#include "tests/parity/plane_input.h"

namespace quorum {
namespace {

class FirstPlanesParity : public ParityTest {
 protected:
  /// outside: whether some pixels prefer a plane beyond the bounds.
  static void compare(int width, int height, bool outside, unsigned seed) {
    SweepTask task = make_planes_task(5, 30, true, width, height, seed);
    Grid<PixelVote> votes = sweep_planes(task, task.ranges, task.planes.refinement, {});
    std::mt19937 random(seed);
    for (std::size_t pixel = 0; pixel < votes.values.size(); ++pixel) {
      const PlaneRange& range = task.ranges.values[pixel];
      if (range.first > range.last || random() % 3 != 0) continue;
      const auto plane = range.first + static_cast<std::uint32_t>(random()) % (range.last - range.first + 1);
      votes.values[pixel] = {0.8F, 0.4F, static_cast<int>(plane)};  // some that stand alone
    }
    if (outside) {
      task.outside = Grid<OutsidePlane>(width >> kOutsideHalvings, height >> kOutsideHalvings);
      for (OutsidePlane& plane : task.outside.values)
        if (random() % 3 == 0) plane = {0.01F, std::uniform_real_distribution<float>(0.0F, 1.0F)(random)};
    }
    const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
    std::vector<PixelPlane> twin;
    for (const PlaneTrial& plane : first_planes(task, votes).values)
      twin.push_back({plane.inverse_depth, plane.slope_x, plane.slope_y, 0.0F, 0.0F, plane.inverse_depth != 0.0F});
    const Buffer range_buffer = buffer_of(std::vector<InverseDepthRange>(twin.size(), {7.0F, 7.0F}));
    const Buffer planes = buffer_of(std::vector<PixelPlane>(twin.size(), {7.0F, 7.0F, 7.0F, 7.0F, 7.0F, 7}));
    const FirstPlanesParams params{.width = width,
                                   .height = height,
                                   .outside_width = task.outside.width,
                                   .outside_height = task.outside.height,
                                   .outside_halvings = task.outside_halvings,
                                   .limit = fit_limit(task.planes)};
    const std::vector<OutsidePlane> nothing(1);
    run(kernel("first_planes"), {width, height}, params,
        {buffer_of(votes.values), buffer_of(task.ranges.values), buffer_of(task.planes.inverse_depth),
         buffer_of(outside ? task.outside.values : nothing), range_buffer, planes});
    const std::string what = fmt::format("{}x{} outside {} seed {}", width, height, outside, seed);
    ASSERT_TRUE(same_words(content<InverseDepthRange>(range_buffer), ranges.values, width, what + " ranges"));
    ASSERT_TRUE(same_words(content<PixelPlane>(planes), twin, width, what + " planes"));
    const auto tilted = std::ranges::count_if(twin, [](const PixelPlane& plane) { return plane.slope_x != 0.0F; });
    expect_share(tilted, std::int64_t{width} * height, 0.05, 0.95, what + ", planes with slopes");
    const auto far = std::ranges::count_if(twin, [](const PixelPlane& plane) { return plane.inverse_depth == 0.01F; });
    if (outside) expect_share(far, std::int64_t{width} * height, 0.02, 0.9, what + ", planes beyond the bounds");
  }
};

TEST_F(FirstPlanesParity, EverySizeGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const auto& [width, height] : {std::pair{67, 45}, {131, 61}}) {
    compare(width, height, false, seed++);
    compare(width, height, true, seed++);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace quorum
