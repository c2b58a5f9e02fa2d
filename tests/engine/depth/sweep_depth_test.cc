#include "engine/depth/sweep_depth.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>

#include "engine/depth/refine_depth.h"
#include "engine/depth/vote_depth.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kSweepWidth = 120;
constexpr int kSweepHeight = 90;

bool equal(const PixelVote& a, const PixelVote& b) {
  return a.correlation == b.correlation && a.confidence == b.confidence && a.plane == b.plane;
}

/// The votes window by window, in the words of the paper.
Grid<PixelVote> sweep_by_windows(const SweepTask& task, const Grid<PlaneRange>& ranges, int stride) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  Grid<PixelVote> votes(ranges.width, ranges.height, kNoVote);
  for (int y = 0; y < ranges.height; ++y) {
    for (int x = 0; x < ranges.width; ++x) {
      const PlaneRange& range = ranges.at(x, y);
      for (uint plane = range.first; plane <= range.last; plane += static_cast<uint>(stride)) {
        float sum = 0.0F;
        int count = 0;
        for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
          const float ncc = window_ncc(task, neighbor, x, y, static_cast<int>(plane));
          if (ncc > rule.threshold) sum += ncc, ++count;
        }
        votes.at(x, y) = vote(votes.at(x, y), sum, count, static_cast<int>(plane), rule);
      }
    }
  }
  return votes;
}

void expect_equal(const Grid<PixelVote>& a, const Grid<PixelVote>& b) {
  int found = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      found += a.at(x, y).plane >= 0 ? 1 : 0;
      ASSERT_TRUE(equal(a.at(x, y), b.at(x, y)))
          << "pixel " << x << " " << y << ": plane " << a.at(x, y).plane << " against " << b.at(x, y).plane
          << ", correlation " << a.at(x, y).correlation << " against " << b.at(x, y).correlation;
    }
  }
  EXPECT_GT(found, 300) << "trivial input";
}

TEST(SweepDepth, FindsTheSphere) {
  const SphereScene sphere = make_sphere_scene(5, kSweepWidth, kSweepHeight, true, 1);
  const SweepTask task = make_sphere_task(sphere, 2, {});
  const DepthMap map = sweep_depth(task, {});
  int disk = 0;
  int close = 0;
  for (int y = 0; y < kSweepHeight; ++y) {
    for (int x = 0; x < kSweepWidth; ++x) {
      const double depth = map.depth.at(x, y);
      EXPECT_EQ(depth > 0, map.correlation.at(x, y) > 0);
      if (depth > 0) {
        EXPECT_GT(map.correlation.at(x, y), SweepOptions{}.threshold);
        EXPECT_LE(map.correlation.at(x, y), 1.0F);
        EXPECT_GT(map.confidence.at(x, y), 0.0F);
        EXPECT_LE(map.confidence.at(x, y), 1.0F);
      }
      // Away from the silhouette, where the sphere's edge before black correlates instead (the paper, 4.6).
      if (std::hypot(x - (kSweepWidth - 1) / 2.0, y - (kSweepHeight - 1) / 2.0) > 28.0) continue;
      ++disk;
      close += depth > 0 && std::abs(depth - sphere_depth(sphere.scene.views[2], x, y)) < 0.02 ? 1 : 0;
    }
  }
  EXPECT_GT(disk, 2000);
  EXPECT_GT(close, disk * 9 / 10);
}

TEST(SweepDepth, TheSecondPassIsCloserToTheTruth) {
  const SphereScene sphere = make_sphere_scene(5, kSweepWidth, kSweepHeight, false, 1);
  const auto error = [&](int refinement) {
    SweepOptions options;
    options.step_pixels = 1.0;
    options.refinement = refinement;
    options.window_model = WindowModel::kPlane;
    const DepthMap map = sweep_depth(make_sphere_task(sphere, 2, options), {});
    double sum = 0.0;
    int count = 0;
    for (int y = 30; y < 60; ++y)
      for (int x = 45; x < 75; ++x)
        if (map.depth.at(x, y) > 0)
          sum += std::abs(map.depth.at(x, y) - sphere_depth(sphere.scene.views[2], x, y)), ++count;
    EXPECT_GT(count, 700);
    return sum / count;
  };
  EXPECT_LT(error(10), 0.5 * error(1));
}

TEST(SweepDepth, SharedSamplesGiveTheSameBytesAsSingleWindows) {
  const SphereScene sphere = make_sphere_scene(4, kSweepWidth, kSweepHeight, true, 2);
  for (const int window : {3, 5, 9, 15}) {
    SweepOptions options;
    options.window = window;
    options.step_pixels = 2.0;
    const SweepTask task = make_sphere_task(sphere, 1, options);
    const auto fast = sweep_planes(task, task.ranges, task.planes.refinement, {});
    const auto slow = sweep_by_windows(task, task.ranges, task.planes.refinement);
    expect_equal(fast, slow);
    const auto ranges = refine_ranges(fast, task.planes);
    expect_equal(sweep_planes(task, ranges, 1, {}), sweep_by_windows(task, ranges, 1));
  }
}

TEST(SweepDepth, RowsOfAxisWindowsGiveTheSameBytesAsSingleWindows) {
  const SphereScene sphere = make_sphere_scene(4, kSweepWidth, kSweepHeight, false, 2);
  for (const int window : {3, 5, 9, 15}) {
    SweepOptions options;
    options.window = window;
    options.window_model = WindowModel::kAxis;
    options.step_pixels = 2.0;
    const SweepTask task = make_sphere_task(sphere, 1, options);
    const auto expected = sweep_by_windows(task, task.ranges, task.planes.refinement);
    for (const SimdLevel simd : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      if (simd > best_simd_level()) continue;
      expect_equal(sweep_planes(task, task.ranges, task.planes.refinement, {simd, 37, 11}), expected);
    }
    const auto ranges = refine_ranges(expected, task.planes);
    expect_equal(sweep_planes(task, ranges, 1, {}), sweep_by_windows(task, ranges, 1));
  }
}

TEST(SweepDepth, TilesThreadsAndInstructionsDoNotChangeTheBytes) {
  const SphereScene sphere = make_sphere_scene(4, kSweepWidth, kSweepHeight, true, 3);
  const SweepTask task = make_sphere_task(sphere, 1, {});
  const auto expected = sweep_planes(task, task.ranges, task.planes.refinement, {});
  for (const auto& [tile_width, tile_height] : {std::pair{8, 1}, {16, 64}, {64, 64}, {37, 11}}) {
    for (const SimdLevel simd : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      if (simd > best_simd_level()) continue;
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, tile_width == 16 ? 1 : 2);
      expect_equal(sweep_planes(task, task.ranges, task.planes.refinement, {simd, tile_width, tile_height}), expected);
    }
  }
}

TEST(SweepDepth, AxisWindowsFailOnUpsideDownNeighborsAndPlaneWindowsDoNot) {
  const SphereScene sphere = make_sphere_scene(3, kSweepWidth, kSweepHeight, true, 4);  // view 1 alone is upside down
  const auto found = [&](WindowModel model) {
    SweepOptions options;
    options.window_model = model;
    const DepthMap map = sweep_depth(make_sphere_task(sphere, 1, options), {});
    int close = 0;
    for (int y = 0; y < kSweepHeight; ++y)
      for (int x = 0; x < kSweepWidth; ++x)
        close +=
            map.depth.at(x, y) > 0 && std::abs(map.depth.at(x, y) - sphere_depth(sphere.scene.views[1], x, y)) < 0.02;
    return close;
  };
  const int plane = found(WindowModel::kPlane);
  EXPECT_GT(plane, 2000);
  EXPECT_LT(found(WindowModel::kAxis), plane / 4);
}

TEST(SweepDepth, AxisWindowsWorkOnUprightNeighbors) {
  const SphereScene sphere = make_sphere_scene(5, kSweepWidth, kSweepHeight, false, 4);
  SweepOptions options;
  options.window_model = WindowModel::kAxis;
  const DepthMap map = sweep_depth(make_sphere_task(sphere, 2, options), {});
  int close = 0;
  for (int y = 0; y < kSweepHeight; ++y)
    for (int x = 0; x < kSweepWidth; ++x)
      close +=
          map.depth.at(x, y) > 0 && std::abs(map.depth.at(x, y) - sphere_depth(sphere.scene.views[2], x, y)) < 0.02;
  EXPECT_GT(close, 1500);
}

TEST(SweepDepth, FlatImagesGiveNoDepth) {
  SphereScene sphere = make_sphere_scene(4, kSweepWidth, kSweepHeight, false, 5);
  for (ColorImage& image : sphere.images) image = ColorImage(kSweepWidth, kSweepHeight, make_rgb(90, 90, 90));
  const DepthMap map = sweep_depth(make_sphere_task(sphere, 1, {}), {});
  for (const float depth : map.depth.values) ASSERT_EQ(depth, 0.0F);
}

TEST(SweepDepth, OneVoteIsNotEnough) {
  SphereScene sphere = make_sphere_scene(3, kSweepWidth, kSweepHeight, false, 6);
  const SweepTask two = make_sphere_task(sphere, 1, {});
  sphere.images[2] = ColorImage(kSweepWidth, kSweepHeight, make_rgb(50, 60, 70));  // one neighbor sees nothing
  const DepthMap map = sweep_depth(make_sphere_task(sphere, 1, {}), {});
  for (const float depth : map.depth.values) ASSERT_EQ(depth, 0.0F);
  SweepOptions lenient;
  lenient.min_votes = 1;
  const DepthMap one_vote = sweep_depth(make_sphere_task(sphere, 1, lenient), {});
  EXPECT_GT(std::count_if(one_vote.depth.values.begin(), one_vote.depth.values.end(), [](float d) { return d > 0; }),
            1000);
}

TEST(Vote, FollowsTheFormulasOfThePaper) {
  const VoteRule rule = make_vote_rule({.threshold = 0.6F}, 4);
  const PixelVote result = vote(kNoVote, 0.9F + 0.7F + 0.8F, 3, 17, rule);
  EXPECT_EQ(result.plane, 17);
  EXPECT_NEAR(result.correlation, 0.8, 1e-6);
  EXPECT_NEAR(result.confidence, (0.3 + 0.1 + 0.2) / (4 * 0.4), 1e-6);
}

TEST(Vote, KeepsTheFirstOfEqualPlanesAndTheBetterOne) {
  const VoteRule rule = make_vote_rule({}, 4);
  const PixelVote first = vote(kNoVote, 1.6F, 2, 3, rule);
  EXPECT_EQ(vote(first, 1.6F, 2, 4, rule).plane, 3);
  EXPECT_EQ(vote(first, 1.7F, 2, 4, rule).plane, 4);
  EXPECT_EQ(vote(first, 0.99F, 1, 4, rule).plane, 3);
  EXPECT_EQ(vote(kNoVote, 0.0F, 0, 4, rule).plane, -1);
}

TEST(RefineRanges, AreTheOpenIntervalAroundTheBestPlane) {
  DepthPlanes planes;
  planes.refinement = 10;
  planes.depth.assign(41, 1.0F);
  Grid<PixelVote> votes(4, 1, kNoVote);
  votes.at(0, 0).plane = 20;
  votes.at(1, 0).plane = 0;
  votes.at(2, 0).plane = 40;
  const auto ranges = refine_ranges(votes, planes);
  EXPECT_EQ(ranges.at(0, 0).first, 11U);
  EXPECT_EQ(ranges.at(0, 0).last, 29U);
  EXPECT_EQ(ranges.at(1, 0).first, 0U);
  EXPECT_EQ(ranges.at(1, 0).last, 9U);
  EXPECT_EQ(ranges.at(2, 0).first, 31U);
  EXPECT_EQ(ranges.at(2, 0).last, 40U);
  EXPECT_GT(ranges.at(3, 0).first, ranges.at(3, 0).last);
}

}  // namespace
}  // namespace quorum
