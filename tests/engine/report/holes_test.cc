#include "engine/report/holes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace quorum {
namespace {

constexpr int kSide = 20;

/// A unit square at z = 0, seen from +z counterclockwise, without the cells for which `gone` holds.
template <typename Gone>
Mesh square_without(const Gone& gone) {
  Mesh mesh;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) {
      mesh.vertices.emplace_back();
      mesh.vertices.back().position = Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 0) / kSide;
    }
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      if (gone(x, y)) continue;
      const auto at = [](int column, int row) { return static_cast<std::uint32_t>(row * (kSide + 1) + column); };
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

const Bounds kBounds = {{0, 0, -1}, {1, 1, 1}};  // cut the square at its border

TEST(Holes, AnOpeningHasItsPlaceSizeAndSide) {
  const Mesh mesh = square_without([](int x, int y) { return x >= 4 && x < 8 && y >= 10 && y < 12; });
  const auto holes = find_holes(mesh, kBounds);
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_NEAR(holes[0].diameter, 0.2, 1e-6);
  EXPECT_LT((holes[0].center - Eigen::Vector3d(0.3, 0.55, 0)).norm(), 1e-6);
  EXPECT_LT((holes[0].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
  EXPECT_EQ(holes[0].edges.size(), 12U);
}

TEST(Holes, WhatTheBoundsCutIsNoneAndTheBackOfASheetIsOne) {
  EXPECT_TRUE(find_holes(square_without([](int, int) { return false; }), kBounds).empty());
  const auto back = find_holes(square_without([](int, int) { return false; }), {{-1, -1, -1}, {2, 2, 1}});
  ASSERT_EQ(back.size(), 1U);
  EXPECT_LT((back[0].normal + Eigen::Vector3d::UnitZ()).norm(), 1e-6);
}

TEST(Holes, SmallOnesAreLeftOutAndTheWidestComesFirst) {
  const Mesh mesh = square_without([](int x, int y) {
    return (x == 2 && y == 2) || (x >= 5 && x < 7 && y == 5) || (x >= 10 && x < 15 && y >= 10 && y < 15);
  });
  const auto all = find_holes(mesh, kBounds);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NEAR(all[0].diameter, 0.25, 1e-6);
  EXPECT_NEAR(all[2].diameter, 0.05, 1e-6);
  EXPECT_EQ(find_holes(mesh, kBounds, 0.06).size(), 2U);
  EXPECT_EQ(find_holes(mesh, kBounds, 0.0, 1).size(), 1U);
}

/// A camera at a point that looks at the middle of the square.
View view_from(const Eigen::Vector3d& center) {
  View view;
  view.width = view.height = 100;
  view.camera.intrinsics << 100, 0, 49.5, 0, 100, 49.5, 0, 0, 1;
  const Eigen::Vector3d forward = (Eigen::Vector3d(0.5, 0.5, 0) - center).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  view.camera.camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  view.camera.translation = -view.camera.camera_from_world * center;
  return view;
}

TEST(Holes, ViewsThatLookInAreCountedAndTheNearestLieOnBothSides) {
  const Mesh mesh = square_without([](int x, int y) { return x >= 8 && x < 12 && y >= 8 && y < 12; });
  auto holes = find_holes(mesh, kBounds);
  Scene scene;
  scene.bounds = kBounds;
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0.6, 0.5, 3), Eigen::Vector3d(0.8, 0.5, 3), Eigen::Vector3d(-1, 0.5, 3),
        Eigen::Vector3d(0.5, 0.4, -3), Eigen::Vector3d(0.6, 0.7, 3)})
    scene.views.push_back(view_from(center));
  const auto found = find_views(
      scene, [](int view) -> Expected<Grid<float>> { return Grid<float>(100, 100, view == 4 ? 1.0F : 0.0F); }, holes);
  ASSERT_TRUE(found);
  EXPECT_EQ(holes[0].seen_by, (std::vector<int>{0, 1, 2}));  // 3 is behind, and before 4 something stands
  EXPECT_EQ(holes[0].nearest, (std::vector<int>{0, 2}));
  EXPECT_NEAR(angle_to_view(holes[0], scene.views[3]), 178.1, 0.1);
}

TEST(Holes, AFailureToReadIsPassedOn) {
  auto holes = find_holes(square_without([](int x, int y) { return x == 4 && y == 4; }), kBounds);
  Scene scene;
  scene.views.push_back(view_from({0.5, 0.4, 3}));
  EXPECT_FALSE(find_views(
      scene, [](int) -> Expected<Grid<float>> { return failure(ErrorKind::kInput, "gone"); }, holes));
}

}  // namespace
}  // namespace quorum
