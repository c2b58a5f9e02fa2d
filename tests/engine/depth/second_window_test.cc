#include "engine/depth/second_window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/depth/sweep_depth.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kSecondWidth = 110;
constexpr int kSecondHeight = 80;

/// A view of the sphere, its depth map, and both maps together.
struct SecondWindow : ::testing::TestWithParam<WindowModel> {
  void SetUp() override {
    SweepOptions options;
    options.second_window = 9;
    options.window_model = GetParam();
    task = make_sphere_task(sphere, 1, options);
    first = sweep_depth(task, {});
    second_task = make_second_task(task, first);
    second = sweep_depth(second_task, {});
    both = first;
    take_missing(second, both);
  }

  const SphereScene sphere = make_weak_sphere_scene(4, kSecondWidth, kSecondHeight, 8);
  SweepTask task;
  SweepTask second_task;
  DepthMap first, second, both;
};

TEST_P(SecondWindow, OnlyPixelsWithoutADepthTakeIt) {
  int taken = 0;
  for (std::size_t pixel = 0; pixel < first.depth.values.size(); ++pixel) {
    const DepthMap& from = first.depth.values[pixel] != 0.0F ? first : second;
    taken += first.depth.values[pixel] == 0.0F && second.depth.values[pixel] != 0.0F ? 1 : 0;
    ASSERT_EQ(both.depth.values[pixel], from.depth.values[pixel]);
    ASSERT_EQ(both.confidence.values[pixel], from.confidence.values[pixel]);
    ASSERT_EQ(both.correlation.values[pixel], from.correlation.values[pixel]);
    if (!both.normal.empty()) {
      ASSERT_EQ(both.normal.values[pixel], from.normal.values[pixel]);
    }
  }
  EXPECT_GT(taken, 50);
}

TEST_P(SecondWindow, WhatItFindsLiesOnTheSphere) {
  int taken = 0;
  int right = 0;
  for (int y = 0; y < kSecondHeight; ++y) {
    for (int x = 0; x < kSecondWidth; ++x) {
      if (first.depth.at(x, y) != 0.0F || both.depth.at(x, y) == 0.0F) continue;
      const double truth = sphere_depth(sphere.scene.views[1], x, y);
      ++taken;
      right += std::abs(static_cast<double>(both.depth.at(x, y)) - truth) < 0.04 ? 1 : 0;
    }
  }
  EXPECT_GT(right, taken / 3) << taken;
}

TEST_P(SecondWindow, SweepsWherePixelsMissADepthAndWindowsFit) {
  EXPECT_EQ(second_task.options.window, 9);
  std::int64_t swept = 0;
  std::int64_t all = 0;
  for (int y = 0; y < kSecondHeight; ++y) {
    for (int x = 0; x < kSecondWidth; ++x) {
      const PlaneRange& range = second_task.ranges.at(x, y);
      const PlaneRange& before = task.ranges.at(x, y);
      const bool fits = x >= 4 && y >= 4 && x < kSecondWidth - 4 && y < kSecondHeight - 4;
      all += before.first <= before.last ? 1 : 0;
      if (range.first <= range.last) {
        ++swept;
        ASSERT_TRUE(fits);
        ASSERT_EQ(range.first, before.first);
        ASSERT_EQ(range.last, before.last);
      } else if (fits && before.first <= before.last) {
        ASSERT_NE(first.depth.at(x, y), 0.0F);
      }
    }
  }
  EXPECT_GT(swept, 0);
  EXPECT_LT(swept, all);
}

INSTANTIATE_TEST_SUITE_P(Models, SecondWindow, ::testing::Values(WindowModel::kSlanted, WindowModel::kPlane));

}  // namespace
}  // namespace quorum
