#include "engine/volume/confirm_depths.h"

#include <gtest/gtest.h>

#include "tests/support/confirm_task.h"

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

std::shared_ptr<const ViewDepths> plane_seen_from(double x, double depth) {
  return shared({Grid<float>(kSide, kSide, static_cast<float>(depth)), camera_at(x)});
}

/// Support of the middle of a plane at kDepth by a view beside it that sees a plane at another depth.
int support_by(double other_depth) {
  const ConfirmTask task{plane_seen_from(0, kDepth), {plane_seen_from(0.1, other_depth)}, {}};
  Grid<int> support(kSide, kSide);
  confirm_depths(*task.view, *task.others[0], make_confirm_depths_params(task, 0), best_simd_level(), support);
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
  confirm_depths(*task.view, *task.others[0], make_confirm_depths_params(task, 0), best_simd_level(), support);
  EXPECT_EQ(support.at(14, kCenter), 0);
  EXPECT_EQ(support.at(16, kCenter), 4);
  // It is behind the plane and looks away.
  ConfirmTask behind = task;
  changed(behind.others[0]).camera.translation = {0, 0, -3};
  confirm_depths(*behind.view, *behind.others[0], make_confirm_depths_params(behind, 0), best_simd_level(), support);
  EXPECT_EQ(support.at(kCenter, kCenter), 0);
}

TEST(ConfirmDepths, ASlantedSurfaceIsInterpolated) {
  // z = 2 + x / 2, seen from both; the nearest pixel's depth would be off by up to half a footprint.
  const auto seen_from = [](double x) {
    ViewDepths view{Grid<float>(kSide, kSide), camera_at(x)};
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u)
        view.depth.at(u, v) = static_cast<float>((kDepth + x / 2) / (1 - (u - kCenter) / kConfirmFocal / 2));
    return shared(std::move(view));
  };
  const ConfirmTask task{seen_from(0), {seen_from(0.11)}, {}};
  ConfirmDepthsParams params = make_confirm_depths_params(task, 0);
  params.footprint *= 0.02F;  // agreement to a hundredth of a footprint
  Grid<int> support(kSide, kSide);
  confirm_depths(*task.view, *task.others[0], params, best_simd_level(), support);
  for (int x = 10; x < 30; ++x) EXPECT_EQ(support.at(x, kCenter), 4) << x;
}

/// A wall at kDepth, of which the view sees another, further one in place of the wall in a square around its middle.
/// What the view beside it sees in front of the square's depths is the wall.
ConfirmTask task_with_a_pit(double pit_depth, float certainty, float other_certainty) {
  constexpr int kPit = 8;  // half of its side, pixels
  ConfirmTask task{plane_seen_from(0, kDepth), {plane_seen_from(0.11, kDepth)}, {}};
  ViewDepths& view = changed(task.view);
  for (int y = kCenter - kPit; y <= kCenter + kPit; ++y)
    for (int x = kCenter - kPit; x <= kCenter + kPit; ++x) view.depth.at(x, y) = static_cast<float>(pit_depth);
  view.certainty = Grid<float>(kSide, kSide, certainty);
  changed(task.others[0]).certainty = Grid<float>(kSide, kSide, other_certainty);
  return task;
}

TEST(ConfirmDepths, ADepthThatLooksThroughASurerOneIsDenied) {
  constexpr double kPitDepth = kDepth + 4 * kFootprint;
  const auto center_of = [](const ConfirmTask& task) { return confirm_depths(task).at(kCenter, kCenter); };
  EXPECT_EQ(center_of(task_with_a_pit(kPitDepth, 0.25F, 0.5F)), 0.0F);
  EXPECT_EQ(center_of(task_with_a_pit(kPitDepth, 0.5F, 0.5F)), certainty_of(0)) << "as sure as the other";
  EXPECT_EQ(center_of(task_with_a_pit(kPitDepth, 0.5F, 0.25F)), certainty_of(0)) << "surer than the other";
  EXPECT_EQ(center_of(task_with_a_pit(kDepth + 1.9 * kFootprint, 0.25F, 0.5F)), certainty_of(0)) << "not far enough";
  ConfirmTask first = task_with_a_pit(kPitDepth, 0.25F, 0.5F);
  changed(first.view).certainty = {};
  EXPECT_EQ(center_of(first), certainty_of(0)) << "no round came before";
  EXPECT_EQ(confirm_depths(task_with_a_pit(kPitDepth, 0.25F, 0.5F)).at(3 * kCenter / 2 + 1, 2), certainty_of(4))
      << "the wall that both see";
}

TEST(ConfirmDepths, WhatTheViewSeesItselfDoesNotDeny) {
  // The wall hides the pit from the other view, but the view sees the wall beside the pit, at the pixels where the
  // other's depths in front of the pit's border lie.
  constexpr int kPitBorder = kCenter + 8;
  constexpr double kDeep = 3 * kDepth;
  const ConfirmTask task = task_with_a_pit(kDeep, 0.25F, 0.5F);
  const Grid<float> certainty = confirm_depths(task);
  EXPECT_GT(certainty.at(kPitBorder, kCenter), 0.0F);
  // The wall in one of the four pixels around is enough.
  ConfirmTask pillar = task_with_a_pit(kDepth + 4 * kFootprint, 0.25F, 0.5F);
  changed(pillar.view).depth.at(kCenter + 1, kCenter) = static_cast<float>(kDepth);
  EXPECT_GT(confirm_depths(pillar).at(kCenter, kCenter), 0.0F);
  EXPECT_EQ(confirm_depths(pillar).at(kCenter + 3, kCenter), 0.0F);
}

TEST(ConfirmDepths, CertaintyRisesWithSupport) {
  EXPECT_LT(certainty_of(-kConfirmingViews), 0.05F);
  EXPECT_GT(certainty_of(4 * kConfirmingViews), 0.99F);
  for (int support = -kConfirmingViews; support < 4 * kConfirmingViews; ++support)
    EXPECT_LE(certainty_of(support), certainty_of(support + 1)) << support;
}

TEST(ConfirmDepths, WithoutOtherViewsAllDepthsAreUnconfirmed) {
  ConfirmTask task{plane_seen_from(0, kDepth), {}, {}};
  changed(task.view).depth.at(3, 4) = 0;
  const Grid<float> certainty = confirm_depths(task);
  EXPECT_EQ(certainty.at(3, 4), 0.0F);
  EXPECT_EQ(certainty.at(4, 4), certainty_of(0));
}

}  // namespace
}  // namespace quorum
