#include "engine/volume/depth_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quorum {
namespace {

Camera make_camera() {
  Camera camera;
  camera.intrinsics << 100, 0, 20, 0, 110, 15, 0, 0, 1;
  return camera;
}

/// Depth of the plane normal · p = distance at a pixel.
float plane_depth(const Camera& camera, const Eigen::Vector3d& normal, double distance, int x, int y) {
  const Eigen::Vector3d ray((x - camera.intrinsics(0, 2)) / camera.intrinsics(0, 0),
                            (y - camera.intrinsics(1, 2)) / camera.intrinsics(1, 1), 1.0);
  return static_cast<float>(distance / normal.dot(ray));
}

TEST(DepthNormals, OfAPlaneAreItsOwnTowardTheCamera) {
  const Camera camera = make_camera();
  for (const double scale : {1.0, 1000.0, 0.001}) {
    const Eigen::Vector3d normal = Eigen::Vector3d(0.5, -0.3, -1.0).normalized();
    Grid<float> depth(40, 30);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) depth.at(x, y) = plane_depth(camera, normal, -5.0 * scale, x, y);
    const auto normals = depth_normals(depth, camera);
    for (const Eigen::Vector3f& found : normals.values) ASSERT_LT((found - normal.cast<float>()).norm(), 1e-3F);
  }
}

TEST(DepthNormals, DoNotMixBothSidesOfAStep) {
  const Camera camera = make_camera();
  Grid<float> depth(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) depth.at(x, y) = x < 20 ? 5.0F : 7.0F;
  const auto normals = depth_normals(depth, camera);
  for (const Eigen::Vector3f& found : normals.values) ASSERT_LT((found - Eigen::Vector3f(0, 0, -1)).norm(), 1e-3F);
}

TEST(DepthNormals, AreZeroWithoutDepthAndAlongTheRayForALonePixel) {
  const Camera camera = make_camera();
  Grid<float> depth(40, 30);
  depth.at(10, 5) = 3.0F;
  const auto normals = depth_normals(depth, camera);
  EXPECT_EQ(normals.at(11, 5), Eigen::Vector3f(0, 0, 0));
  const Eigen::Vector3d toward = -Eigen::Vector3d((10 - 20) / 100.0, (5 - 15) / 110.0, 1).normalized();
  EXPECT_LT((normals.at(10, 5) - toward.cast<float>()).norm(), 1e-6F);
}

}  // namespace
}  // namespace quorum
