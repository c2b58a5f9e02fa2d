#include "engine/volume/confirm_depths.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

constexpr int kSide = 41;
constexpr int kCenter = kSide / 2;
constexpr double kConfirmFocal = 100;
constexpr double kDepth = 2.0;
constexpr double kFootprint = kDepth / kConfirmFocal;

/// Looks along z from x.
Camera camera_at(double x) {
  Camera camera;
  camera.intrinsics << kConfirmFocal, 0, kCenter, 0, kConfirmFocal, kCenter, 0, 0, 1;
  camera.translation = {-x, 0, 0};
  return camera;
}

ViewDepths plane_seen_from(double x, double depth) {
  return {Grid<float>(kSide, kSide, static_cast<float>(depth)), camera_at(x)};
}

/// Support of the middle of a plane at kDepth by a view beside it that sees a plane at another depth.
int support_by(double other_depth) {
  const ConfirmTask task{plane_seen_from(0, kDepth), {plane_seen_from(0.1, other_depth)}, {}};
  Grid<int> support(kSide, kSide);
  confirm_depths(task.view.depth, task.others[0].depth, make_confirm_depths_params(task, 0), support);
  return support.at(kCenter, kCenter);
}

TEST(ConfirmDepths, AgreementCountsByTheFootprintOfAPixel) {
  EXPECT_EQ(support_by(kDepth), 4);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(support_by(kDepth + sign * 0.48 * kFootprint), 4);
    EXPECT_EQ(support_by(kDepth + sign * 0.52 * kFootprint), 2);
    EXPECT_EQ(support_by(kDepth + sign * 0.98 * kFootprint), 2);
    EXPECT_EQ(support_by(kDepth + sign * 1.02 * kFootprint), 0);
  }
}

TEST(ConfirmDepths, OnlyAViewThatLooksThroughContradicts) {
  EXPECT_EQ(support_by(kDepth + 1.98 * kFootprint), 0);
  EXPECT_EQ(support_by(kDepth + 2.02 * kFootprint), -1);
  EXPECT_EQ(support_by(kDepth + 30 * kFootprint), -1);
  EXPECT_EQ(support_by(kDepth - 30 * kFootprint), 0) << "it sees something in front";
  EXPECT_EQ(support_by(0), 0) << "it has no depth";
}

TEST(ConfirmDepths, WhatAnotherViewDoesNotSeeItDoesNotSupport) {
  // The other view is 0.3 to the right: 15 pixels of the plane's left part leave its image.
  const ConfirmTask task{plane_seen_from(0, kDepth), {plane_seen_from(0.3, kDepth)}, {}};
  Grid<int> support(kSide, kSide);
  confirm_depths(task.view.depth, task.others[0].depth, make_confirm_depths_params(task, 0), support);
  EXPECT_EQ(support.at(14, kCenter), 0);
  EXPECT_EQ(support.at(16, kCenter), 4);
  // It is behind the plane and looks away.
  ConfirmTask behind = task;
  behind.others[0].camera.translation = {0, 0, -3};
  confirm_depths(behind.view.depth, behind.others[0].depth, make_confirm_depths_params(behind, 0), support);
  EXPECT_EQ(support.at(kCenter, kCenter), 0);
}

TEST(ConfirmDepths, ASlantedSurfaceIsInterpolated) {
  // z = 2 + x / 2, seen from both; the nearest pixel's depth would be off by up to half a footprint.
  const auto seen_from = [](double x) {
    ViewDepths view{Grid<float>(kSide, kSide), camera_at(x)};
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u)
        view.depth.at(u, v) = static_cast<float>((kDepth + x / 2) / (1 - (u - kCenter) / kConfirmFocal / 2));
    return view;
  };
  const ConfirmTask task{seen_from(0), {seen_from(0.11)}, {}};
  ConfirmDepthsParams params = make_confirm_depths_params(task, 0);
  params.footprint *= 0.02F;  // agreement to a hundredth of a footprint
  Grid<int> support(kSide, kSide);
  confirm_depths(task.view.depth, task.others[0].depth, params, support);
  for (int x = 10; x < 30; ++x) EXPECT_EQ(support.at(x, kCenter), 4) << x;
}

TEST(ConfirmDepths, CertaintyRisesWithSupport) {
  EXPECT_LT(certainty_of(-kConfirmingViews), 0.05F);
  EXPECT_GT(certainty_of(4 * kConfirmingViews), 0.99F);
  for (int support = -kConfirmingViews; support < 4 * kConfirmingViews; ++support)
    EXPECT_LE(certainty_of(support), certainty_of(support + 1)) << support;
}

TEST(ConfirmDepths, WithoutOtherViewsAllDepthsAreUnconfirmed) {
  ConfirmTask task{plane_seen_from(0, kDepth), {}, {}};
  task.view.depth.at(3, 4) = 0;
  const Grid<float> certainty = confirm_depths(task);
  EXPECT_EQ(certainty.at(3, 4), 0.0F);
  EXPECT_EQ(certainty.at(4, 4), certainty_of(0));
}

}  // namespace
}  // namespace quorum
