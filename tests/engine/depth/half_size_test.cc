#include "engine/depth/half_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/depth/sweep_depth.h"
#include "tests/support/outside_task.h"

namespace quorum {
namespace {

constexpr int kWidth = 176;
constexpr int kHeight = 132;
constexpr int kReference = 1;

struct HalfSize : ::testing::Test {
  const SphereScene sphere = make_weak_sphere_scene(4, kWidth, kHeight, 8);
  const View& view = sphere.scene.views[kReference];
  const SweepTask task = make_sphere_task(sphere, kReference, {});
  const DepthMap full = sweep_depth(task, {});
  const SweepTask half = make_half_task(task, full, view, sphere_neighbors(sphere, kReference), small_images());
  const DepthMap coarse = sweep_depth(half, {});
};

TEST_F(HalfSize, PlanesAreTwiceAsFarApartAndReachAsFar) {
  EXPECT_EQ(half.reference->width, kWidth / 2);
  EXPECT_EQ(half.planes.inverse_depth.front(), task.planes.inverse_depth.front());
  EXPECT_EQ(half.planes.inverse_depth.back(), task.planes.inverse_depth.back());
  EXPECT_EQ(half.planes.inverse_depth[0] - half.planes.inverse_depth[1],
            task.planes.inverse_depth[0] - task.planes.inverse_depth[2 * 10]);
  for (int y = 0; y < half.ranges.height; ++y) {
    for (int x = 0; x < half.ranges.width; ++x) {
      const PlaneRange& range = half.ranges.at(x, y);
      const PlaneRange& own = task.ranges.at(2 * x, 2 * y);
      if (range.first > range.last || own.first > own.last) continue;
      ASSERT_GE(half.planes.inverse_depth[range.first], task.planes.inverse_depth[own.first]);
      ASSERT_LE(half.planes.inverse_depth[range.last], task.planes.inverse_depth[own.last]);
    }
  }
}

TEST_F(HalfSize, OnlyWhatIsMissingIsSwept) {
  DepthMap whole = full;
  std::ranges::fill(whole.depth.values, 4.0F);
  const auto ranges_of = [&](const DepthMap& map) {
    return make_half_task(task, map, view, sphere_neighbors(sphere, kReference), small_images()).ranges;
  };
  const auto is_swept = [](const PlaneRange& range) { return range.first <= range.last; };
  EXPECT_TRUE(std::ranges::none_of(ranges_of(whole).values, is_swept));
  whole.depth.at(90, 61) = 0.0F;
  const Grid<PlaneRange> around = ranges_of(whole);
  for (int y = 0; y < around.height; ++y)
    for (int x = 0; x < around.width; ++x)
      ASSERT_EQ(is_swept(around.at(x, y)), std::abs(x - 45) <= 3 && std::abs(y - 30) <= 3) << x << " " << y;
}

TEST_F(HalfSize, FillsWithWhatLiesOnTheSphereAndWeighsLess) {
  DepthMap map = full;
  take_from_half(task, half, coarse, map);
  int taken = 0;
  int right = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (full.depth.at(x, y) != 0.0F) {
        ASSERT_EQ(map.depth.at(x, y), full.depth.at(x, y));
        ASSERT_EQ(map.confidence.at(x, y), full.confidence.at(x, y));
        continue;
      }
      if (map.depth.at(x, y) == 0.0F) continue;
      ++taken;
      right += std::abs(map.depth.at(x, y) - sphere_depth(view, x, y)) < 0.05 ? 1 : 0;
      ASSERT_EQ(map.confidence.at(x, y), 0.25F * coarse.confidence.at(x / 2, y / 2));
      ASSERT_EQ(map.correlation.at(x, y), coarse.correlation.at(x / 2, y / 2));
      ASSERT_NEAR(map.normal.at(x, y).norm(), 1.0F, 1e-5F);
    }
  }
  EXPECT_GT(taken, 300);
  EXPECT_GT(right, taken * 95 / 100);
}

TEST_F(HalfSize, TheRimOfAPatchIsNotTaken) {
  DepthMap cut = coarse;
  for (int y = 0; y < cut.depth.height; ++y) cut.depth.at(44, y) = 0.0F;
  DepthMap map = full;
  take_from_half(task, half, cut, map);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 2 * 42; x < 2 * 47; ++x) ASSERT_EQ(map.depth.at(x, y), full.depth.at(x, y));
}

TEST_F(HalfSize, WhatLiesBeyondTheBoundsIsNotSeenInThem) {
  SphereScene before = make_sphere_scene(5, kWidth, kHeight, false, 3);
  before.scene.bounds = {{-0.7, -0.7, -2.6}, {0.7, 0.7, -1.4}};  // before the sphere
  SweepTask looking = make_sphere_task(before, kReference, {});
  look_outside(before, kReference, looking);
  const DepthMap map = sweep_depth(looking, {});
  SweepTask small = make_half_task(looking, map, before.scene.views[kReference], sphere_neighbors(before, kReference),
                                   small_images());
  const auto depths_of = [](const SweepTask& swept) {
    return std::ranges::count_if(sweep_depth(swept, {}).depth.values, [](float depth) { return depth > 0.0F; });
  };
  const std::int64_t looked = depths_of(small);
  small.outside = {};
  EXPECT_LT(looked, depths_of(small) / 10);
}

}  // namespace
}  // namespace quorum
