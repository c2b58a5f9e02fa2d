#include "engine/depth/project.h"

#include <gtest/gtest.h>

#include "engine/depth/plane_warp.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

TEST(Project, AgreesWithTheCamerasInDoublePrecision) {
  const SphereScene sphere = make_sphere_scene(4, 640, 480, true, 1);
  const Camera& reference = sphere.scene.views[1].camera;
  int inside = 0;
  for (std::size_t neighbor : {std::size_t{0}, std::size_t{2}, std::size_t{3}}) {
    const Camera& camera = sphere.scene.views[neighbor].camera;
    const PlaneWarp warp = make_plane_warp(reference, camera);
    for (int y = 0; y < 480; y += 37) {
      for (int x = 0; x < 640; x += 41) {
        const double depth = 3.0 + 0.002 * (x + y);
        const Projection position = project(warp, x, y, static_cast<float>(1.0 / depth), 640, 480, 0);
        const Eigen::Vector3d truth = camera.project(reference.unproject(x, y, depth));
        if (!position.inside) {
          EXPECT_FALSE(truth.x() > 0.01 && truth.y() > 0.01 && truth.x() < 638.99 && truth.y() < 478.99);
          continue;
        }
        ++inside;
        EXPECT_NEAR(position.u / 256.0, truth.x(), 0.004);
        EXPECT_NEAR(position.v / 256.0, truth.y(), 0.004);
      }
    }
  }
  EXPECT_GT(inside, 200);
}

TEST(Project, PointsBehindTheNeighborAreNotInside) {
  PlaneWarp warp{};
  warp.rotation[0] = warp.rotation[4] = 1.0F;
  warp.rotation[8] = -1.0F;
  EXPECT_FALSE(project(warp, 10, 10, 0.5F, 640, 480, 0).inside);
  warp.rotation[8] = 0.0F;
  EXPECT_FALSE(project(warp, 10, 10, 0.5F, 640, 480, 0).inside);
}

TEST(Project, PositionsInsideKeepTheMargin) {
  PlaneWarp warp{};
  warp.rotation[0] = warp.rotation[4] = warp.rotation[8] = 1.0F;
  const auto inside = [&](int x, int y, int margin) { return project(warp, x, y, 0.5F, 640, 480, margin).inside; };
  EXPECT_TRUE(inside(0, 479, 0));
  EXPECT_TRUE(inside(639, 0, 0));
  EXPECT_FALSE(inside(640, 0, 0));
  EXPECT_TRUE(inside(2, 477, 2 * kPositionScale));
  EXPECT_FALSE(inside(1, 240, 2 * kPositionScale));
  EXPECT_FALSE(inside(320, 478, 2 * kPositionScale));
}

}  // namespace
}  // namespace quorum
