#include "engine/mesh/make_manifold.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

Mesh loose_mesh(const std::vector<Eigen::Vector3f>& positions,
                const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Mesh mesh;
  for (const Eigen::Vector3f& position : positions)
    mesh.vertices.push_back({.position = position, .confidence = position.x() + 1.0F});
  mesh.triangles = triangles;
  return mesh;
}

TEST(MakeManifold, ASoundMeshStaysAsItIs) {
  const Mesh mesh = loose_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Mesh result = make_manifold(mesh);
  EXPECT_EQ(result.triangles, mesh.triangles);
  ASSERT_EQ(result.vertices.size(), 4U);
  EXPECT_EQ(result.vertices[2].position, mesh.vertices[2].position);
}

TEST(MakeManifold, ATriangleOfTwoPlacesIsClosedWithoutACrack) {
  // 1 and 2 lie at one place; the triangles on either side of 0-1-2 become neighbors.
  const Mesh result = make_manifold(
      loose_mesh({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}}));
  EXPECT_EQ(result.vertices.size(), 4U);
  EXPECT_EQ(result.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 3, 1}}));
}

TEST(MakeManifold, ATriangleOnALineOrInAPointGoes) {
  const Mesh result = make_manifold(
      loose_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}, {0, 1, 3}, {4, 4, 4}}));
  EXPECT_EQ(result.vertices.size(), 3U);
  EXPECT_EQ(result.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
}

TEST(MakeManifold, SurfacesThatTouchInAVertexAreParted) {
  const Mesh result =
      make_manifold(loose_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  ASSERT_EQ(result.vertices.size(), 6U);
  EXPECT_EQ(result.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {5, 3, 4}}));
  EXPECT_EQ(result.vertices[5].position, result.vertices[0].position);
  EXPECT_EQ(result.vertices[5].confidence, result.vertices[0].confidence);
}

TEST(MakeManifold, AnEdgeOfThreeTrianglesPartsThem) {
  const Mesh result = make_manifold(
      loose_mesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(result.vertices.size(), 9U);
}

TEST(MakeManifold, ACloudAndNothingStay) {
  EXPECT_EQ(make_manifold(loose_mesh({{0, 0, 0}, {0, 0, 0}}, {})).vertices.size(), 2U);
  EXPECT_TRUE(make_manifold({}).vertices.empty());
}

}  // namespace
}  // namespace quorum
