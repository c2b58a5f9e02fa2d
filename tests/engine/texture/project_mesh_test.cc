#include "engine/texture/project_mesh.h"

#include <gtest/gtest.h>

#include <random>

namespace quorum {
namespace {

ProjectedVertex at(double x, double y) { return snap({x, y, 1}); }

TEST(ProjectMesh, TrianglesThatShareAnEdgeLeaveNoPixelBetweenThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 40);
  for (int trial = 0; trial < 200; ++trial) {
    const ProjectedVertex middle = at(place(random), place(random));
    const ProjectedVertex corners[] = {at(-1, -1), at(41, -1), at(41, 41), at(-1, 41)};
    std::vector<int> covered(40 * 40);
    for (int i = 0; i < 4; ++i)
      TrianglePixels(middle, corners[i], corners[(i + 1) % 4]).for_each(40, 40, [&](int x, int y, const auto& shares) {
        ++covered[static_cast<std::size_t>(y * 40 + x)];
        EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-12);
      });
    EXPECT_EQ(std::ranges::count(covered, 0), 0) << trial;
  }
}

TEST(ProjectMesh, FrontsHaveNegativeAreasAndSharesBelongToCorners) {
  const TrianglePixels front(at(1, 1), at(1, 9), at(9, 1));  // counterclockwise where y points down
  EXPECT_LT(front.signed_area(), 0);
  EXPECT_EQ(front.area(), 32);
  EXPECT_EQ(front.shares(1, 9), (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(front.shares(5, 5), (std::array<double, 3>{0, 0.5, 0.5}));
  EXPECT_TRUE(front.covers(5, 5));
  EXPECT_FALSE(front.covers(6, 5));
}

TEST(ProjectMesh, ATriangleWithoutAreaCoversNothing) {
  const TrianglePixels line(at(1, 1), at(5, 5), at(9, 9));
  EXPECT_EQ(line.signed_area(), 0);
  int pixels = 0;
  line.for_each(20, 20, [&](int, int, const auto&) { ++pixels; });
  EXPECT_EQ(pixels, 0);
  EXPECT_NEAR(line.shares(3, 3)[1], 1 / 3.0, 1e-12);
}

TEST(ProjectMesh, WhatIsBehindOrFarOffIsOutOfReach) {
  View view;
  view.camera.intrinsics << 100, 0, 50, 0, 100, 50, 0, 0, 1;
  Mesh mesh;
  mesh.vertices = {
      {.position = {0, 0, 2}}, {.position = {0, 0, 4}}, {.position = {0, 0, -2}}, {.position = {9e6F, 0, 2}}};
  const ProjectedMesh projected = project_mesh(mesh, view);
  EXPECT_EQ(projected.vertices[0].x, 50 * kSubpixels);
  EXPECT_EQ(projected.vertices[0].nearness, 1U << 31);
  EXPECT_EQ(projected.vertices[1].nearness, 1U << 30);
  EXPECT_EQ(projected.vertices[2].nearness, 0U);
  EXPECT_EQ(projected.vertices[3].nearness, 0U);
}

}  // namespace
}  // namespace quorum
