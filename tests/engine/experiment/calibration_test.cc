#include "engine/experiment/calibration.h"

#include <gtest/gtest.h>

#include "tests/support/test_support.h"

namespace quorum {
namespace {

TEST(Calibration, BinsHoldTheShareOfRightDepths) {
  Calibration calibration;
  EXPECT_EQ(calibration.error(), 0.0);
  for (int i = 0; i < 4; ++i) calibration.add(0.25, i == 0);
  calibration.add(1.0, true);
  EXPECT_EQ(calibration.count(), 5U);
  EXPECT_EQ(calibration.bins[2].count, 4U);
  EXPECT_EQ(calibration.bins[2].share(), 0.25);
  EXPECT_EQ(calibration.bins[9].share(), 1.0);
  EXPECT_EQ(calibration.error(), 0.0);
  calibration.add(0.95, false);
  EXPECT_NEAR(calibration.error(), (1.95 - 1.0) / 6, 1e-12);
}

/// A wall at depth 2 before one camera; the depths in the left half are right, those in the right one are off by three
/// footprints.
TEST(Calibration, DepthsAreRightWithinAFootprintOfTheTruth) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  Scene scene;
  View& view = scene.views.emplace_back();
  view.name = std::string("wall");
  view.width = view.height = 30;
  view.camera.intrinsics << 100, 0, 15, 0, 100, 15, 0, 0, 1;
  DepthMap map;
  map.depth = map.correlation = map.confidence = Grid<float>(30, 30, 0.55F);
  Grid<float> certainty(30, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 30; ++x) {
      map.depth.at(x, y) = x < 15 ? 2.019F : 2.061F;
      certainty.at(x, y) = x < 15 ? 0.98F : 0.02F;
    }
  }
  Mesh wall;
  for (const float y : {-9.0F, 9.0F})
    for (const float x : {-9.0F, 9.0F}) wall.vertices.emplace_back().position = {x, y, 2.0F};
  wall.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_FALSE(calibrate(scene, workspace, wall)) << "there is no depth map";
  workspace.save_depth_map(view.name, map).value();
  EXPECT_FALSE(calibrate(scene, workspace, wall)) << "there is no certainty";
  workspace.save_certainty(view.name, certainty).value();

  const auto result = calibrate(scene, workspace, wall);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->confidence.bins[5].count, 100U);
  EXPECT_EQ(result->confidence.bins[5].right, 50U);
  EXPECT_EQ(result->certainty.bins[0].right, 0U);
  EXPECT_EQ(result->certainty.bins[9].right, 50U);
  EXPECT_NEAR(result->certainty.error(), 0.02, 1e-6);

  const CalibrationCurve curves[] = {{"first", result->confidence}, {"second", result->certainty}};
  const std::string svg = calibration_svg(curves);
  EXPECT_NE(svg.find("first"), std::string::npos);
  EXPECT_NE(svg.find("M62.4 336.0L369.6 16.0"), std::string::npos) << svg;
}

}  // namespace
}  // namespace quorum
