#include "engine/scene/parallax.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/scene/copies.h"
#include "tests/engine/scene/camera_paths.h"

namespace quorum {
namespace {

std::vector<int> neighbors_of(const Scene& scene, int reference, int count = 4) {
  return select_by_parallax(scene, reference, count, 90.0);
}

double distance(const Scene& scene, int a, int b) {
  const auto center = [&](int view) -> Eigen::Vector3d {
    return scene.views[static_cast<std::size_t>(view)].camera.center();
  };
  return (center(a) - center(b)).norm();
}

TEST(SampleRays, LieOnTheRaysOfTheViewInsideTheBounds) {
  const Scene scene = room(9);
  const auto points = sample_rays(scene.views[0], scene.bounds);
  EXPECT_EQ(points.size(), 512U) << "every ray of a view in a box meets it";
  for (const RayPoint& point : points) {
    EXPECT_LT(point.position.cwiseAbs().maxCoeff(), 3.2);
    const Eigen::Vector3d pixel = scene.views[0].camera.project(point.position);
    EXPECT_GT(pixel.z(), 0.0);
    EXPECT_TRUE(pixel.x() > 0 && pixel.x() < 319 && pixel.y() > 0 && pixel.y() < 239) << pixel.transpose();
    EXPECT_NEAR(point.pixels_per_unit, 300 / pixel.z(), 1e-9);
  }
}

TEST(SampleRays, KeepToTheDepthRange) {
  Scene scene = room(9);
  scene.views[0].near_depth = 1.5;
  scene.views[0].far_depth = 2.0;
  const auto points = sample_rays(scene.views[0], scene.bounds);
  ASSERT_FALSE(points.empty());
  for (const RayPoint& point : points) {
    EXPECT_GT(scene.views[0].camera.to_camera(point.position).z(), 1.5);
    EXPECT_LT(scene.views[0].camera.to_camera(point.position).z(), 2.0);
  }
}

TEST(SampleRays, AreNoneWhereTheViewMissesTheBounds) {
  Scene scene = orbit(4);
  scene.bounds = {{10, 10, 10}, {11, 11, 11}};
  EXPECT_TRUE(sample_rays(scene.views[0], scene.bounds).empty());
  scene.bounds = {};
  EXPECT_TRUE(sample_rays(scene.views[0], scene.bounds).empty());
  EXPECT_TRUE(neighbors_of(scene, 0).empty());
}

TEST(Parallax, IsThatOfTheBaseline) {
  const Scene scene = orbit(36);
  const auto points = sample_rays(scene.views[0], scene.bounds);
  EXPECT_NEAR(parallax_deg(points, scene.views[1].camera.center()), 10.0, 1.0);
  EXPECT_LT(parallax_deg(points, scene.views[0].camera.center()), 1e-9);
}

TEST(SelectByParallax, OnAnOrbitTakesBothSides) {
  const Scene scene = orbit(24);
  std::vector<int> chosen = neighbors_of(scene, 0);
  std::ranges::sort(chosen);
  EXPECT_EQ(chosen, (std::vector<int>{1, 2, 22, 23}));
}

TEST(SelectByParallax, OnADenseOrbitTakesEnoughAngle) {
  const Scene scene = orbit(180);
  for (const int view : neighbors_of(scene, 0)) EXPECT_GE(std::min(view, 180 - view), 4) << "8 degrees";
}

TEST(SelectByParallax, OnAStripTakesWhatIsBesideIt) {
  const Scene scene = strip(8);
  for (int view = 0; view < 8; ++view) {
    const auto chosen = neighbors_of(scene, view);
    ASSERT_GE(chosen.size(), 2U) << view;
    for (const int other : chosen) EXPECT_LE(std::abs(other - view), 4) << view;
  }
}

TEST(SelectByParallax, NeverTakesAViewFromTheSamePlace) {
  const Scene scene = pans(6);
  for (int view = 0; view < 18; ++view) {
    const auto chosen = neighbors_of(scene, view);
    ASSERT_EQ(chosen.size(), 4U);
    for (const int other : chosen) EXPECT_GT(distance(scene, view, other), 0.3) << view << " " << other;
  }
}

TEST(SelectByParallax, FindsNothingWhereAllTurnOnTheSpot) {
  Scene scene = turn(12);
  for (int view = 0; view < 12; ++view) EXPECT_TRUE(neighbors_of(scene, view).empty());
  for (int view = 0; view < 12; ++view)  // not quite on the spot
    scene.views[static_cast<std::size_t>(view)].camera.translation.x() += view % 2 == 0 ? 0.003 : -0.003;
  for (int view = 0; view < 12; ++view) EXPECT_TRUE(neighbors_of(scene, view).empty());
}

TEST(SelectByParallax, InARoomTakesThoseThatSeeTheSameWall) {
  const Scene scene = room(45);
  for (int view = 0; view < 45; ++view) {
    const auto chosen = neighbors_of(scene, view);
    ASSERT_EQ(chosen.size(), 4U);
    for (const int other : chosen) {
      const int apart = std::abs(other - view);
      EXPECT_LE(std::min(apart, 45 - apart), 6) << view << " " << other;
    }
  }
}

TEST(SelectByParallax, OnAWalkFindsNeighborsForEveryView) {
  const Scene scene = walk(12);
  for (int view = 0; view < 12; ++view) EXPECT_GE(neighbors_of(scene, view).size(), 2U) << view;
}

TEST(SelectByParallax, TakesALikeResolution) {
  Scene scene = orbit(24);
  for (const std::size_t view : {1U, 23U}) scene.views[view].camera.intrinsics.topRows(2) *= 0.25;
  const auto chosen = neighbors_of(scene, 0, 2);
  EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()), (std::set<int>{2, 22}));
}

TEST(SelectByParallax, IsTheSameAtAnyScaleAndPlace) {
  const Scene scene = walk(12);
  for (int view = 0; view < 12; ++view) {
    const auto chosen = neighbors_of(scene, view);
    for (const double scale : {1.0, 1024.0, 1.0 / 1024.0}) {
      const Eigen::Vector3d offset = scale * Eigen::Vector3d(4096, 32768, 128);
      Scene moved = scene;
      moved.bounds = {scale * scene.bounds.low + offset, scale * scene.bounds.high + offset};
      for (View& other : moved.views)
        other.camera.translation = -other.camera.camera_from_world * (scale * other.camera.center() + offset);
      EXPECT_EQ(neighbors_of(moved, view), chosen) << scale << " " << view;
    }
  }
}

TEST(ParallaxScore, AsksTheMiddleHalfOfEachRay) {
  // The reference looks along x through a box of 16. Another view shows what is nearer than a quarter of that.
  const Scene scene{
      {view_from({0, 0, 0}, looking(0)), view_from({1, -3, 0}, looking(90)), view_from({0, 2, 0}, looking(0))},
      {{0, -8, -8}, {16, 8, 8}}};
  EXPECT_EQ(neighbors_of(scene, 0), (std::vector<int>{2, 1})) << "points near the camera are enough to be taken";
  EXPECT_EQ(parallax_score(scene, 0, {1}, 90.0), 0.0);
  EXPECT_GT(parallax_score(scene, 0, {2}, 90.0), 1.0);
  EXPECT_EQ(parallax_score(scene, 0, {1, 2}, 90.0), parallax_score(scene, 0, {2}, 90.0));
  EXPECT_EQ(parallax_score(scene, 0, {}, 90.0), 0.0);
}

TEST(IsCopy, IsEveryViewButTheFirstWithOneContentFromOnePlace) {
  Scene scene = orbit(6);
  scene.views.push_back(scene.views[2]);
  scene.views.push_back(scene.views[2]);
  for (int view = 0; view < 8; ++view) EXPECT_EQ(is_copy(scene, view), view >= 6) << view;
  scene.views[7].camera.intrinsics.topLeftCorner(2, 2) *= 3.0;
  EXPECT_FALSE(is_copy(scene, 7)) << "shows less, and finer";
}

TEST(IsCopy, IsNoViewThatTurnsOnTheSpot) {
  const Scene scene = turn(12);
  for (int view = 0; view < 12; ++view) EXPECT_FALSE(is_copy(scene, view)) << view;
}

TEST(IsCopy, IsRememberedUntilItIsLookedAtAgain) {
  Scene scene = orbit(6);
  mark_copies(scene);
  for (const View& view : scene.views) EXPECT_EQ(view.is_copy, false);
  scene.views.push_back(scene.views[2]);
  EXPECT_FALSE(is_copy(scene, 6)) << "what was remembered came with the view";
  mark_copies(scene);
  EXPECT_TRUE(is_copy(scene, 6));
  EXPECT_EQ(scene.views[2].is_copy, false);
}

TEST(SelectByParallax, OfManyViewsSomeOfTheNearestAreLookedAt) {
  Scene scene = orbit(static_cast<int>(kManyViews) + 200);
  mark_copies(scene);
  for (const int view : {0, 7, 600}) {
    const auto chosen = neighbors_of(scene, view);
    ASSERT_EQ(chosen.size(), 4U);
    for (const int other : chosen)  // of the 512 nearest
      EXPECT_LE(distance(scene, view, other), distance(scene, 0, 257)) << other;
  }
}

TEST(SelectByParallax, TakesNoCopies) {
  Scene scene = orbit(24);
  const auto chosen = neighbors_of(scene, 0, 6);
  const std::vector<View> once = scene.views;
  scene.views.insert(scene.views.end(), once.begin(), once.end());
  EXPECT_EQ(neighbors_of(scene, 0, 6), chosen);
}

}  // namespace
}  // namespace quorum
