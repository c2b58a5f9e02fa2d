#include "engine/scene/select_views.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "tests/engine/scene/camera_paths.h"

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

/// Cameras at these angles around the origin, 4 units away, looking at it; 40 points near it that all views see.
Scene around_points(const std::vector<double>& angles_deg) {
  Scene scene = scene_at(angles_deg);
  std::vector<int> all;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    scene.views[i].camera.intrinsics << 500, 0, 320, 0, 500, 240, 0, 0, 1;
    scene.views[i].camera.translation = {0, 0, 4};
    all.push_back(static_cast<int>(i));
  }
  for (int i = 0; i < 40; ++i) scene.points.push_back({{0.01 * i, -0.01 * (i % 7), 0.02 * (i % 5)}, all});
  return scene;
}

TEST(SelectViewsByPoints, TakesWhoSharesMostPoints) {
  Scene scene = around_points({0, 20, -20, 40, -40});
  for (std::size_t i = 0; i < 30; ++i) std::erase(scene.points[i].views, 1);
  for (std::size_t i = 0; i < 10; ++i) std::erase(scene.points[i].views, 2);
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{3, 4, 2, 1}));
}

TEST(SelectViewsByPoints, TakesAnglesOfTenDegreesAndMoreAndSpreadsThem) {
  const Scene scene = around_points({0, 2, 15, 16, -15, 31});
  SelectViewsOptions options;
  options.neighbor_count = 3;
  std::vector<int> chosen = select_views(scene, 0, options);
  std::ranges::sort(chosen);
  EXPECT_EQ(chosen, (std::vector<int>{2, 4, 5}));
}

TEST(SelectViewsByPoints, TakesALikeResolution) {
  Scene scene = around_points({0, 20, -20, 40});
  scene.views[1].camera.intrinsics.topRows(2) *= 0.25;
  scene.views[2].camera.intrinsics.topRows(2) *= 1.5;
  SelectViewsOptions options;
  options.neighbor_count = 2;
  EXPECT_EQ(select_views(scene, 0, options), (std::vector<int>{2, 3}));
}

TEST(SelectViewsByPoints, LeavesOutWhoSharesNextToNothing) {
  Scene scene = around_points({0, 20, -20, 100, 40});
  for (SparsePoint& point : scene.points) std::erase(point.views, 4);
  scene.points[0].views.push_back(4);
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{1, 2, 4})) << "view 3 looks from more than 90 degrees";
  scene.points.insert(scene.points.end(), 60, SparsePoint{{0, 0, 0}, {0, 1, 2}});
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{1, 2}));
}

TEST(SelectViewsByPoints, IsTheSameAtAnyScale) {
  Scene scene = around_points({0, 12, 9, -14, 33, -25, 40, 5});
  const auto chosen = select_views(scene, 0, {});
  for (const double scale : {1000.0, 0.001}) {
    Scene scaled = scene;
    for (View& view : scaled.views) view.camera.translation *= scale;
    for (SparsePoint& point : scaled.points) point.position *= scale;
    EXPECT_EQ(select_views(scaled, 0, {}), chosen);
  }
}

TEST(SelectViews, NeighborsOfTheFilesComeFirstUnlessARuleIsGiven) {
  Scene scene = around_points({0, 20, -20, 40, -40, 60});
  scene.views[0].neighbors = {5, 4, 3, 2, 1};
  EXPECT_EQ(select_views(scene, 0, {}), (std::vector<int>{5, 4, 3, 2}));
  SelectViewsOptions options;
  options.rule = ViewRule::kAngle;
  EXPECT_EQ(select_views(scene, 0, options), (std::vector<int>{1, 2, 3, 4}));
}

TEST(SelectViews, WithoutPointsThePapersRuleStaysWhereItSees) {
  const Scene scene = orbit(24);
  SelectViewsOptions paper;
  paper.rule = ViewRule::kAngle;
  for (int view = 0; view < 24; ++view) EXPECT_EQ(select_views(scene, view, {}), select_views(scene, view, paper));
}

TEST(SelectViews, WithoutPointsParallaxIsAskedWhereThePapersRuleIsBlind) {
  SelectViewsOptions paper;
  paper.rule = ViewRule::kAngle;
  SelectViewsOptions parallax;
  parallax.rule = ViewRule::kParallax;
  EXPECT_TRUE(select_views(strip(8), 3, paper).empty());
  EXPECT_EQ(select_views(pans(6), 7, paper), (std::vector<int>{0, 2})) << "from other places, by luck";
  for (const Scene& scene : {strip(8), pans(6)}) {
    for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
      EXPECT_EQ(select_views(scene, view, {}), select_views(scene, view, parallax));
      EXPECT_GE(select_views(scene, view, {}).size(), 2U);
    }
  }
}

TEST(SelectViews, ViewsFromOnePlaceAreNeverNeighborsWhoeverNamesThem) {
  Scene scene = turn(12);
  EXPECT_TRUE(select_views(scene, 5, {}).empty());
  scene.views[5].neighbors = {4, 6, 3};
  EXPECT_TRUE(select_views(scene, 5, {}).empty());
  for (int i = 0; i < 40; ++i)
    scene.points.push_back({{0.3 + 2.5, 0.1 * (i % 7), 0.05 * i - 1}, {0, 1, 2, 3, 4, 5, 6}});
  EXPECT_TRUE(select_views(scene, 5, {}).empty());
  SelectViewsOptions options;
  options.rule = ViewRule::kPoints;
  EXPECT_TRUE(select_views(scene, 5, options).empty());
}

TEST(SelectViews, ViewsOfOneContentFromOnePlaceCountOnce) {
  Scene scene = around_points({0, 20, -20, 40, -40});
  for (View& view : scene.views) {
    view.width = 640;
    view.height = 480;
  }
  scene.bounds = {Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1)};
  const auto chosen = select_views(scene, 0, {});
  ASSERT_EQ(chosen.size(), 4U);
  const std::vector<View> once = scene.views;
  scene.views.insert(scene.views.end(), once.begin(), once.end());
  for (SparsePoint& point : scene.points) point.views = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(select_views(scene, 0, {}), chosen);
  EXPECT_TRUE(select_views(scene, 5, {}).empty()) << "repeats view 0";
}

TEST(SelectViews, ACopyLeavesItsPlaceToTheNext) {
  Scene scene = orbit(16);
  SelectViewsOptions paper;
  paper.rule = ViewRule::kAngle;
  const auto chosen = select_views(scene, 2, paper);
  scene.views.insert(scene.views.begin(), scene.views[3]);  // view 3, which is now 4, repeats it
  EXPECT_TRUE(select_views(scene, 4, {}).empty());
  const auto with_copy = select_views(scene, 3, {});
  EXPECT_EQ(with_copy.size(), chosen.size());
  EXPECT_EQ(std::ranges::count(with_copy, 0), 1);
  EXPECT_EQ(std::ranges::count(with_copy, 4), 0);
}

TEST(SelectViews, AViewWithoutPointsIsHelpedByParallax) {
  Scene scene = orbit(24);
  for (int i = 0; i < 40; ++i) scene.points.push_back({{0.01 * i, -0.01 * (i % 7), 0.02 * (i % 5)}, {0, 1, 2, 22, 23}});
  EXPECT_GE(select_views(scene, 12, {}).size(), 2U);
}

TEST(NoNeighborsError, SaysWhetherThePhotographsAreFromOnePlace) {
  const Error one_place = no_neighbors_error(turn(12), {});
  EXPECT_EQ(one_place.kind, ErrorKind::kInput);
  EXPECT_NE(one_place.message.find("from about one place"), std::string::npos);
  const Error apart = no_neighbors_error(orbit(3), {});
  EXPECT_NE(apart.message.find("no view has two neighbor views"), std::string::npos);
  EXPECT_NE(apart.message.find("max-angle"), std::string::npos);
}

}  // namespace
}  // namespace quorum
