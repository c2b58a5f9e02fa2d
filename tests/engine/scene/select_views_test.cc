#include "engine/scene/select_views.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace quorum {
namespace {

/// Views that look along directions at these angles in the x-z plane.
Scene scene_at(const std::vector<double>& angles_deg) {
  Scene scene;
  for (const double angle : angles_deg) {
    View view;
    view.camera.camera_from_world =
        Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()).toRotationMatrix();
    scene.views.push_back(view);
  }
  return scene;
}

TEST(SelectViews, TakesTheClosestByAngle) {
  const Scene scene = scene_at({0, 50, 10, -20, 35, -41});
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{2, 3, 4, 5}));
}

TEST(SelectViews, LeavesOutViewsCloserThanFourDegreesToTheReference) {
  const Scene scene = scene_at({0, 3.9, -3.9, 4.1, 10});
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{3, 4}));
}

TEST(SelectViews, LeavesOutViewsCloserThanFourDegreesToEachOther) {
  const Scene scene = scene_at({0, 10, 13.9, 14.1, -9});
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{4, 1, 3}));
}

TEST(SelectViews, OfEqualAnglesTakesTheFirstInTheScene) {
  SelectViewsOptions options;
  options.neighbor_count = 2;
  const Scene scene = scene_at({0, 90, -10, 10, -10});
  EXPECT_EQ(select_views(scene, 0, options), (std::vector<int>{2, 3}));
}

TEST(SelectViews, TurningTheCameraAboutItsAxisChangesNothing) {
  Scene scene = scene_at({0, 10, 20, 30});
  const Eigen::Matrix3d half_turn = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scene.views[2].camera.camera_from_world = half_turn * scene.views[2].camera.camera_from_world;
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{1, 2, 3}));
}

TEST(SelectViews, MayFindFewerThanAskedFor) {
  EXPECT_TRUE(select_views(scene_at({0}), 0, {}).empty());
  EXPECT_TRUE(select_views(scene_at({0, 170}), 0, {}).empty());
  EXPECT_EQ(select_views(scene_at({0, 20}), 0, {}).size(), 1U);
}

TEST(SelectViewsOptions, NamesTheOptionOutOfRange) {
  SelectViewsOptions options;
  options.neighbor_count = 1;
  ASSERT_FALSE(options.check());
  EXPECT_NE(options.check().error().message.find("--neighbors 1"), std::string::npos);
  EXPECT_EQ(options.check().error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace quorum
