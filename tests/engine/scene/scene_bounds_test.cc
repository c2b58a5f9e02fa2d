#include "engine/scene/scene_bounds.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/engine/scene/camera_paths.h"

namespace quorum {
namespace {

/// Cameras on a ring of radius 4 around the origin that look inward, 640 x 480.
Scene ring(int views) {
  Scene scene;
  for (int i = 0; i < views; ++i) {
    View view;
    view.width = 640;
    view.height = 480;
    view.camera.intrinsics << 600, 0, 320, 0, 600, 240, 0, 0, 1;
    view.camera.camera_from_world =
        Eigen::AngleAxisd(6.283185307 * i / views, Eigen::Vector3d::UnitY()).toRotationMatrix();
    view.camera.translation = {0, 0, 4};
    scene.views.push_back(view);
  }
  return scene;
}

/// Points in the box from (-1, -2, -0.5) to (1, 2, 0.5), all seen by three views; outliers of them lie far away.
std::vector<SparsePoint> points_in_box(int count, int outliers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  std::vector<SparsePoint> points;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d position(spread(random), 2 * spread(random), 0.5 * spread(random));
    if (i < outliers) position *= 1000.0;
    points.push_back({position, {0, 1, 2}});
  }
  return points;
}

TEST(FindBounds, BoxOfThePointsIsRobust) {
  for (const int outliers : {0, 20, 200}) {
    Scene scene = ring(3);
    scene.points = points_in_box(1000, outliers);
    const Bounds box = find_bounds(scene).value();
    for (int axis = 0; axis < 3; ++axis) {
      const double half = axis == 0 ? 1.0 : axis == 1 ? 2.0 : 0.5;
      // Half of the points lie within half of the box; three times that beyond them, and the margin.
      const double most = outliers == 0 ? 1.05 * half + 0.2 : 4.6 * half + 1.0;
      EXPECT_LT(box.low(axis), -0.95 * half) << outliers;
      EXPECT_GT(box.low(axis), -most) << outliers;
      EXPECT_GT(box.high(axis), 0.95 * half) << outliers;
      EXPECT_LT(box.high(axis), most) << outliers;
    }
  }
}

TEST(FindBounds, KeepsWhatStandsOffAWallThatHoldsMostPoints) {
  Scene scene = ring(3);
  scene.points = points_in_box(1000, 0);
  for (std::size_t i = 0; i < 850; ++i) scene.points[i].position.x() = 1.0;
  const Bounds box = find_bounds(scene).value();
  EXPECT_LT(box.low.x(), -0.5);
  EXPECT_GT(box.high.x(), 1.0);
}

TEST(FindBounds, PointsOfTwoViewsCountOnlyWhereThereAreNoOthers) {
  Scene scene = ring(3);
  scene.points = points_in_box(1000, 0);
  for (int i = 0; i < 200; ++i) scene.points.push_back({{50.0 + i, 0, 0}, {0, 1}});
  EXPECT_LT(find_bounds(scene).value().high.x(), 2.0);
  scene.points.erase(scene.points.begin(), scene.points.begin() + 1000);
  EXPECT_GT(find_bounds(scene).value().low.x(), 20.0);
}

TEST(FindBounds, ScaleWithTheScene) {
  Scene scene = ring(3);
  scene.points = points_in_box(1000, 20);
  const Bounds box = find_bounds(scene).value();
  for (SparsePoint& point : scene.points) point.position *= 1024.0;
  EXPECT_EQ(find_bounds(scene).value().low, 1024.0 * box.low);
  EXPECT_EQ(find_bounds(scene).value().high, 1024.0 * box.high);
}

TEST(FindBounds, WithoutPointsTheyAreTheCommonFieldOfView) {
  const Bounds box = find_bounds(ring(12)).value();
  EXPECT_LT(box.center().norm(), 0.3);
  EXPECT_GT(box.size().minCoeff(), 2.0);
  EXPECT_LT(box.size().maxCoeff(), 8.0);
}

TEST(FindBounds, DepthRangesLimitTheCommonFieldOfView) {
  Scene scene = ring(3);
  for (View& view : scene.views) {
    view.camera = scene.views[0].camera;  // all from one place: nothing else limits the depth
    view.near_depth = 2.0;
    view.far_depth = 6.0;
  }
  const Bounds box = find_bounds(scene).value();
  EXPECT_NEAR(box.low.z(), -2.0, 0.5);
  EXPECT_NEAR(box.high.z(), 2.0, 0.5);
}

TEST(FindBounds, NoCommonFieldOfViewIsRefused) {
  Scene parallel = ring(4);
  for (std::size_t i = 0; i < 4; ++i) {
    parallel.views[i].camera = parallel.views[0].camera;
    parallel.views[i].camera.translation.x() = static_cast<double>(i);
  }
  Scene outward = ring(4);
  for (View& view : outward.views) view.camera.translation.z() = -4;
  for (const Scene& scene : {parallel, outward, turn(4), walk(12), room(30)}) {
    const auto box = find_bounds(scene);
    ASSERT_FALSE(box);
    EXPECT_EQ(box.error().kind, ErrorKind::kInput);
    EXPECT_NE(box.error().message.find("no common field of view"), std::string::npos);
    EXPECT_NE(box.error().message.find("option bounds"), std::string::npos);
  }
}

TEST(FindDepthRanges, HoldThePointsThatAViewSees) {
  Scene scene = ring(4);
  scene.points = points_in_box(1000, 0);
  scene.bounds = find_bounds(scene).value();
  scene.points.push_back({{0, 0, 300}, {0, 1, 2}});  // beyond the bounds
  find_depth_ranges(scene);
  EXPECT_LT(scene.views[0].near_depth, 3.5);
  EXPECT_GT(scene.views[0].near_depth, 2.5);
  EXPECT_GT(scene.views[0].far_depth, 4.5);
  EXPECT_LT(scene.views[0].far_depth, 6.0);
  EXPECT_EQ(scene.views[3].far_depth, 0.0) << "sees no point";
}

}  // namespace
}  // namespace quorum
