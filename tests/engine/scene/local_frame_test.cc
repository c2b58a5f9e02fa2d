#include "engine/scene/local_frame.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

TEST(LocalFrame, ASceneNearItsOriginKeepsEveryBit) {
  const Scene before = make_sphere_scene(5, 32, 24, false, 1).scene;
  Scene after = before;
  enter_local_frame(after);
  EXPECT_EQ(after.offset, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < before.views.size(); ++i)
    EXPECT_EQ(after.views[i].camera.translation, before.views[i].camera.translation);
}

TEST(LocalFrame, WhatIsTakenOffIsRoundAndPutBack) {
  Scene scene = make_sphere_scene(5, 32, 24, false, 1).scene;
  const Eigen::Vector3d to(500000.123, 4600000.5, -17.25);
  for (View& view : scene.views) view.camera.translation -= view.camera.camera_from_world * to;
  scene.points.push_back({to, {0, 1}});
  Scene local = scene;
  enter_local_frame(local);
  EXPECT_NE(local.offset, Eigen::Vector3d::Zero());
  EXPECT_EQ(local.offset.array().round().matrix(), local.offset);
  EXPECT_LT((local.offset - to).norm(), 8.0);
  EXPECT_LT((local.points[0].position + local.offset - to).norm(), 1e-8);
  const Eigen::Vector3d at(0.3, -0.2, 0.1);
  for (std::size_t i = 0; i < scene.views.size(); ++i)
    EXPECT_LT((local.views[i].camera.project(at + to - local.offset) - scene.views[i].camera.project(at + to)).norm(),
              1e-6);
  local.bounds = in_local_frame({to.array() - 1.0, to.array() + 1.0}, local);
  const Scene back = in_world(local);
  EXPECT_EQ(back.offset, Eigen::Vector3d::Zero());
  EXPECT_LT((back.bounds.center() - to).norm(), 1e-8);
  EXPECT_LT((back.views[2].camera.translation - scene.views[2].camera.translation).norm(), 1e-8);
}

TEST(LocalFrame, OffsetsAreTakenOnlyFarOff) {
  EXPECT_EQ(far_offset({60, 0, 0}, 1.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(far_offset({1234.56, -0.4, 0.6}, 1.5), Eigen::Vector3d(1235, 0, 1));
  EXPECT_EQ(far_offset({123456.0, 0, 0}, 150.0), Eigen::Vector3d(123500, 0, 0));
  EXPECT_EQ(far_offset({0, 0, 0}, 0.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(far_offset({2.6, 0, 0}, 0.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(far_offset({std::numeric_limits<double>::infinity(), 0, 0}, 1.0), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace quorum
