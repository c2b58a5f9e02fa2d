#include "engine/render/turntable.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <numbers>

namespace quorum {
namespace {

const Eigen::Vector3d kCenter(3, -2, 5);
const Eigen::Vector3d kUp(0, 0, 1);

/// Level, 4 units before the center, which stands in the middle of its picture.
Camera level_camera() {
  Camera camera;
  camera.intrinsics << 50, 0, 20, 0, 50, 15, 0, 0, 1;
  camera.camera_from_world << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.translation = -camera.camera_from_world * (kCenter - Eigen::Vector3d(0, 4, 0));
  return camera;
}

TEST(Turntable, GoesAroundTheCenterAndKeepsItWhereItIsInThePicture) {
  const auto cameras = turntable(level_camera(), kCenter, kUp, 4);
  ASSERT_EQ(cameras.size(), 4U);
  EXPECT_EQ(cameras[0].translation, level_camera().translation);
  const std::array<Eigen::Vector3d, 4> places = {Eigen::Vector3d(0, -4, 0), {4, 0, 0}, {0, 4, 0}, {-4, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((cameras[i].center() - kCenter - places[i]).norm(), 1e-12) << i;
    EXPECT_LT((cameras[i].project(kCenter) - Eigen::Vector3d(20, 15, 4)).norm(), 1e-12) << i;
    EXPECT_EQ(camera_defect(cameras[i]), nullptr) << i;
    EXPECT_LT(cameras[i].project(kCenter + kUp).y(), 15) << "up is up in picture " << i;
  }
}

TEST(Turntable, UpIsWhatThePicturesShow) {
  const auto around = turntable(level_camera(), kCenter, kUp, 7);
  EXPECT_LT((mean_up(around) - kUp).norm(), 1e-12);
  Camera upside_down = level_camera();
  upside_down.camera_from_world =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix() * upside_down.camera_from_world;
  EXPECT_TRUE(mean_up(std::array{level_camera(), upside_down}).isZero(0));
  EXPECT_TRUE(mean_up({}).isZero(0));
}

TEST(Turntable, TheMiddleIsThatOfTheBox) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh;
  mesh.vertices = {
      {.position = {1, 2, 3}}, {.position = {1, 2, 3}}, {.position = {3, 0, 7}}, {.position = {kNone, 0, 0}}};
  EXPECT_EQ(middle_of(mesh), Eigen::Vector3d(2, 1, 5));
  EXPECT_EQ(middle_of({}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace quorum
