#include "engine/depth/outside_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/depth/sweep_depth.h"
#include "tests/support/outside_task.h"

namespace quorum {
namespace {

constexpr int kOutsideWidth = 176;
constexpr int kOutsideHeight = 132;

std::int64_t depths_of(const SweepTask& task) {
  return std::ranges::count_if(sweep_depth(task, {}).depth.values, [](float depth) { return depth > 0.0F; });
}

TEST(OutsidePlanes, CoarsePlanesReachFromTheNearEndToInfinity) {
  const SphereScene sphere = make_sphere_scene(4, kOutsideWidth, kOutsideHeight, true, 1);
  const SweepTask task = make_sphere_task(sphere, 1, {});
  const SweepTask coarse = make_coarse_sphere_task(sphere, 1, task);
  const std::vector<float>& planes = coarse.planes.inverse_depth;
  EXPECT_EQ(planes.front(), task.planes.inverse_depth.front());
  EXPECT_GT(planes.back(), 0.0F);
  EXPECT_LT(planes.back(), 0.1F * task.planes.step());
  EXPECT_TRUE(std::ranges::is_sorted(planes, std::ranges::greater()));
  for (std::size_t i = 1; i + 1 < planes.size(); ++i)
    EXPECT_NEAR(planes[i - 1] - planes[i], 4.0F * task.planes.step(), 1e-6F);
  EXPECT_EQ(coarse.reference->width, kOutsideWidth / 4);
}

TEST(OutsidePlanes, WhatLiesBeyondTheBoundsGetsNoDepth) {
  for (const bool flip : {false, true}) {
    SphereScene sphere = make_sphere_scene(5, kOutsideWidth, kOutsideHeight, flip, 3);
    sphere.scene.bounds = {{-0.7, -0.7, -2.6}, {0.7, 0.7, -1.4}};  // before the sphere
    SweepTask task = make_sphere_task(sphere, 2, {});
    const std::int64_t by_chance = depths_of(task);
    EXPECT_GT(by_chance, 500) << "nothing to get rid of";
    look_outside(sphere, 2, task);
    EXPECT_LT(depths_of(task), by_chance / 50);
  }
}

TEST(OutsidePlanes, WhatLiesInTheBoundsKeepsItsDepth) {
  const SphereScene sphere = make_sphere_scene(5, kOutsideWidth, kOutsideHeight, true, 3);
  SweepTask task = make_sphere_task(sphere, 2, {});
  const std::int64_t before = depths_of(task);
  EXPECT_GT(before, 4000);
  look_outside(sphere, 2, task);
  EXPECT_NEAR(static_cast<double>(depths_of(task)), static_cast<double>(before), 0.01 * static_cast<double>(before));
}

TEST(OutsidePlanes, ASurfaceThatLeavesTheBoundsEndsThere) {
  SphereScene sphere = make_sphere_scene(5, kOutsideWidth, kOutsideHeight, false, 3);
  sphere.scene.bounds = {{-1.05, -1.05, -1.05}, {1.05, 1.05, -0.7}};  // the front of the sphere
  SweepTask task = make_sphere_task(sphere, 2, {});
  look_outside(sphere, 2, task);
  const DepthMap map = sweep_depth(task, {});
  const View& view = sphere.scene.views[2];
  int right = 0;
  int wrong = 0;
  for (int y = 0; y < kOutsideHeight; ++y)
    for (int x = 0; x < kOutsideWidth; ++x)
      if (const double depth = map.depth.at(x, y); depth > 0.0)
        ++(std::abs(depth - sphere_depth(view, x, y)) < 0.05 ? right : wrong);
  EXPECT_GT(right, 1500);
  EXPECT_LT(wrong, right / 20);
}

TEST(OutsidePlanes, AMaskedPixelAndABlackBackgroundPreferNothing) {
  const SphereScene sphere = make_sphere_scene(4, kOutsideWidth, kOutsideHeight, false, 5);
  SweepTask task = make_sphere_task(sphere, 1, {});
  for (int y = 0; y < kOutsideHeight; ++y)
    for (int x = 0; x < kOutsideWidth / 2; ++x) task.ranges.at(x, y) = {1, 0};
  const SweepTask coarse = make_coarse_sphere_task(sphere, 1, task);
  for (int y = 0; y < coarse.ranges.height; ++y)
    for (int x = 0; x < kOutsideWidth / 8; ++x) EXPECT_GT(coarse.ranges.at(x, y).first, coarse.ranges.at(x, y).last);
  look_outside(sphere, 1, task);
  int black = 0;
  for (int y = 2; y < task.outside.height - 2; ++y) {
    for (int x = 2; x < task.outside.width - 2; ++x) {
      bool sees_sphere = false;
      for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx)
          sees_sphere =
              sees_sphere || sphere_depth(sphere.scene.views[1], 4 * (x + dx) + 1.5, 4 * (y + dy) + 1.5) > 0.0;
      if (sees_sphere) continue;
      ++black;
      EXPECT_EQ(task.outside.at(x, y).inverse_depth, 0.0F);
    }
  }
  EXPECT_GT(black, 10);
}

}  // namespace
}  // namespace quorum
