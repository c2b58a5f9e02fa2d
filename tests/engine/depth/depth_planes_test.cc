#include "engine/depth/depth_planes.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/engine/scene/camera_paths.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

const std::vector<int> kNeighbors = {1, 2};

TEST(DepthPlanes, AFixedStepIsKeptInDepth) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  SweepOptions options;
  options.depth_step = 0.1;
  const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, options);
  ASSERT_TRUE(planes);
  EXPECT_EQ(planes->refinement, 10);
  for (std::size_t i = 1; i < planes->depth.size(); ++i)
    EXPECT_NEAR(planes->depth[i] - planes->depth[i - 1], 0.01, 1e-5);
}

TEST(DepthPlanes, CoverTheBounds) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  for (const double step : {0.0, 0.07}) {
    SweepOptions options;
    options.depth_step = step;
    const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, options);
    ASSERT_TRUE(planes);
    for (int corner = 0; corner < 8; ++corner) {
      const double depth = sphere.scene.views[0].camera.to_camera(sphere.scene.bounds.corner(corner)).z();
      EXPECT_GE(depth, planes->depth.front() - 1e-5);
      EXPECT_LE(depth, planes->depth.back() + 1e-5);
    }
  }
}

TEST(DepthPlanes, AnAutomaticStepMovesProjectionsByAtMostItsPixels) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  SweepOptions options;
  options.step_pixels = 0.5;
  const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, options);
  ASSERT_TRUE(planes);
  const auto step = static_cast<std::size_t>(planes->refinement);
  double largest = 0.0;
  for (std::size_t i = step; i < planes->depth.size(); i += step) {
    for (const int neighbor : kNeighbors) {
      const Camera& camera = sphere.scene.views[0].camera;
      const Camera& other = sphere.scene.views[static_cast<std::size_t>(neighbor)].camera;
      const auto at = [&](float depth) -> Eigen::Vector2d {
        return other.project(camera.unproject(31.5, 23.5, depth)).head<2>();
      };
      largest = std::max(largest, (at(planes->depth[i]) - at(planes->depth[i - step])).norm());
    }
  }
  EXPECT_LE(largest, 0.52);
  EXPECT_GT(largest, 0.25);
}

TEST(DepthPlanes, TooManyAreRefused) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  SweepOptions options;
  options.depth_step = 1e-6;
  const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, options);
  ASSERT_FALSE(planes);
  EXPECT_EQ(planes.error().kind, ErrorKind::kUsage);
  EXPECT_NE(planes.error().message.find("option depth-step"), std::string::npos);
}

TEST(DepthPlanes, BoundsBehindTheCameraAreRefused) {
  SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  sphere.scene.bounds = {{-1, -1, -60}, {1, 1, -50}};
  EXPECT_FALSE(make_depth_planes(sphere.scene, 0, kNeighbors, {}));
}

TEST(DepthPlanes, InARoomAroundTheCamerasBeginWhereTwoNeighborsSeeTheSame) {
  const Scene scene = room(45);
  const auto planes = make_depth_planes(scene, 0, {1, 44, 2, 43}, {});
  ASSERT_TRUE(planes) << planes.error().message;
  EXPECT_LT(planes->depth.size(), 10000U);
  EXPECT_LT(planes->depth.front(), 1.5) << "the walls are 2.1 away";
  EXPECT_GT(planes->depth.front(), 0.05);
  EXPECT_GE(planes->depth.back(), 2.3F);
}

TEST(DepthPlanes, InARoomAreNeverTooMany) {
  Scene scene = room(45);
  for (View& view : scene.views) {  // 6400 x 4800
    view.width *= 20;
    view.height *= 20;
    view.camera.intrinsics.topRows(2) *= 20;
  }
  const auto planes = make_depth_planes(scene, 0, {1, 44, 2, 43}, {});
  ASSERT_TRUE(planes) << planes.error().message;
  EXPECT_GT(planes->depth.size(), 10000U);
  EXPECT_LT(planes->depth.front(), 1.5);
}

TEST(PlaneRanges, HoldTheSamplesInsideTheBoundsAndOneMoreAtEachEnd) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, {});
  ASSERT_TRUE(planes);
  const View& view = sphere.scene.views[0];
  const auto ranges = make_plane_ranges(view, sphere.scene.bounds, {}, *planes, 2);
  const auto inside = [&](int x, int y, std::size_t plane) {
    const Eigen::Vector3d point = view.camera.unproject(x, y, planes->depth[plane]);
    return ((point - sphere.scene.bounds.low).array() >= 0).all() &&
           ((sphere.scene.bounds.high - point).array() >= 0).all();
  };
  int swept = 0;
  for (int y = 2; y < 46; ++y) {
    for (int x = 2; x < 62; ++x) {
      const PlaneRange& range = ranges.at(x, y);
      for (std::size_t plane = 0; plane < planes->depth.size(); plane += 10)
        EXPECT_TRUE(!inside(x, y, plane) || (range.first <= plane && plane <= range.last)) << x << " " << y;
      if (range.first > range.last) continue;
      ++swept;
      EXPECT_EQ(range.first % 10, 0U);
      for (std::size_t plane = range.first + 10; plane + 10 <= range.last; plane += 10)
        EXPECT_TRUE(inside(x, y, plane)) << x << " " << y << " " << plane;
    }
  }
  EXPECT_GT(swept, 500);
}

TEST(PlaneRanges, AreEmptyUnderTheMaskAndAtTheBorder) {
  const SphereScene sphere = make_sphere_scene(3, 64, 48, false, 1);
  const auto planes = make_depth_planes(sphere.scene, 0, kNeighbors, {});
  ASSERT_TRUE(planes);
  Mask mask(64, 48, 1);
  mask.at(30, 20) = 0;
  Bounds everything{{-50, -50, -3}, {50, 50, 50}};
  const auto ranges = make_plane_ranges(sphere.scene.views[0], everything, mask, *planes, 2);
  EXPECT_GT(ranges.at(30, 20).first, ranges.at(30, 20).last);
  EXPECT_LE(ranges.at(31, 20).first, ranges.at(31, 20).last);
  EXPECT_GT(ranges.at(1, 20).first, ranges.at(1, 20).last);
  EXPECT_GT(ranges.at(30, 46).first, ranges.at(30, 46).last);
  EXPECT_LE(ranges.at(30, 45).first, ranges.at(30, 45).last);
}

}  // namespace
}  // namespace quorum
