#include "engine/scene/stray_views.h"

#include <gtest/gtest.h>

#include "tests/engine/scene/camera_paths.h"

namespace quorum {
namespace {

using Views = std::vector<int>;

void put(Scene& scene, std::size_t view, const Eigen::Vector3d& center) {
  Camera& camera = scene.views[view].camera;
  camera.translation = -camera.camera_from_world * center;
}

TEST(StrayViews, AreThoseThatStandFarFromAllOthers) {
  Scene scene = orbit(6);
  EXPECT_EQ(stray_views(scene, 100.0), Views());
  put(scene, 2, {0, 100, 0});
  EXPECT_EQ(stray_views(scene, 100.0), Views()) << "an overview";
  EXPECT_EQ(stray_views(scene, 5.0), Views({2}));
  put(scene, 2, {0, 4000, 0});
  EXPECT_EQ(stray_views(scene, 100.0), Views({2}));
  put(scene, 5, {1e12, 0, -1e12});
  EXPECT_EQ(stray_views(scene, 100.0), Views({2, 5}));
}

TEST(StrayViews, AreFoundAtAnyScaleAndPlace) {
  for (const double scale : {1.0, 1e6, 1e-6}) {
    Scene scene = strip(9);
    for (std::size_t view = 0; view < 9; ++view)
      put(scene, view, scale * (scene.views[view].camera.center() + Eigen::Vector3d(1000, -2000, view == 4 ? 1e5 : 0)));
    EXPECT_EQ(stray_views(scene, 100.0), Views({4})) << scale;
  }
}

TEST(StrayViews, AreNoneWhereMostStandInOnePoint) {
  Scene scene = turn(6);
  put(scene, 1, {1000, 0, 0});
  EXPECT_EQ(stray_views(scene, 100.0), Views());
  EXPECT_EQ(stray_views({}, 100.0), Views());
}

TEST(LeaveOut, OthersForgetTheViews) {
  Scene scene = orbit(6);
  scene.views[0].name = "first";
  scene.views[3].name = "fourth";
  scene.views[3].neighbors = {2, 4, 1, 5, 0};
  scene.points = {{{0, 0, 0}, {0, 2, 3, 5}}, {{1, 0, 0}, {2}}, {{2, 0, 0}, {}}};
  leave_out(scene, {2, 4});
  ASSERT_EQ(scene.views.size(), 4U);
  EXPECT_EQ(scene.views[0].name, "first");
  EXPECT_EQ(scene.views[2].name, "fourth");
  EXPECT_EQ(scene.views[2].neighbors, Views({1, 3, 0}));
  ASSERT_EQ(scene.points.size(), 2U) << "one was seen by no view before";
  EXPECT_EQ(scene.points[0].views, Views({0, 2, 3}));
  EXPECT_TRUE(scene.points[1].views.empty());
}

}  // namespace
}  // namespace quorum
