#include "engine/evaluate/sample_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quorum {
namespace {

using Eigen::Vector3d;

Mesh triangles_of(const std::vector<Eigen::Vector3f>& corners) {
  Mesh mesh;
  for (const Eigen::Vector3f& corner : corners) mesh.vertices.push_back({.position = corner});
  for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

/// Triangles side by side along x, triangle i with its corners at x = 2 i, of these heights and base 1.
Mesh row_of_triangles(const std::vector<float>& heights) {
  std::vector<Eigen::Vector3f> corners;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const float x = 2 * static_cast<float>(i);
    corners.insert(corners.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, heights[i], 0}});
  }
  return triangles_of(corners);
}

std::vector<int> samples_per_triangle(const std::vector<Vector3d>& points, std::size_t triangles) {
  std::vector<int> counts(triangles);
  for (const Vector3d& point : points) ++counts.at(static_cast<std::size_t>(point.x() / 2));
  return counts;
}

TEST(SampleSurface, EachTriangleGetsItsShareOfTheAreaWithinOneSample) {
  const std::vector<float> heights = {1, 4, 0.25F, 2, 0.75F, 8, 4};
  const std::vector<Vector3d> points = sample_surface(row_of_triangles(heights), 1000, 3);
  ASSERT_EQ(points.size(), 1000U);
  const std::vector<int> counts = samples_per_triangle(points, heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) EXPECT_NEAR(counts[i], heights[i] / 20.0 * 1000, 1.0) << i;
}

TEST(SampleSurface, SmallTrianglesAreServedTogether) {
  const std::vector<Vector3d> points = sample_surface(row_of_triangles(std::vector<float>(10000, 0.01F)), 100, 3);
  ASSERT_EQ(points.size(), 100U);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(points[i].x() / 200, static_cast<double>(i) + 0.5, 0.51);
}

TEST(SampleSurface, PointsCoverATriangleEvenly) {
  const Mesh triangle = triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  constexpr int kSamples = 10000;
  Vector3d mean = Vector3d::Zero();
  std::array<int, 4> quarters{};
  for (const Vector3d& point : sample_surface(triangle, kSamples, 1)) {
    ASSERT_TRUE(point.x() >= 0 && point.y() >= 0 && point.x() + point.y() <= 1 + 1e-12 && point.z() == 0);
    mean += point / kSamples;
    ++quarters[point.x() > 0.5 ? 0 : point.y() > 0.5 ? 1 : point.x() + point.y() < 0.5 ? 2 : 3];
  }
  EXPECT_NEAR(mean.x(), 1.0 / 3, 1e-3);
  EXPECT_NEAR(mean.y(), 1.0 / 3, 1e-3);
  for (const int count : quarters) EXPECT_NEAR(count, kSamples / 4, kSamples / 200);
}

TEST(SampleSurface, SameSeedGivesTheSamePointsAndAnotherOthers) {
  const Mesh mesh = row_of_triangles({1, 2, 3});
  EXPECT_EQ(sample_surface(mesh, 50, 1), sample_surface(mesh, 50, 1));
  EXPECT_NE(sample_surface(mesh, 50, 1), sample_surface(mesh, 50, 2));
}

TEST(SampleSurface, TrianglesWithoutAreaGetNoPoints) {
  const std::vector<int> counts = samples_per_triangle(sample_surface(row_of_triangles({0, 1, 0, 1, 0}), 100, 1), 5);
  EXPECT_EQ(counts, (std::vector<int>{0, 50, 0, 50, 0}));
}

TEST(SampleSurface, TrianglesWithoutAreaCountTheSameIfThereAreNoOthers) {
  const std::vector<int> counts = samples_per_triangle(sample_surface(row_of_triangles({0, 0}), 100, 1), 2);
  EXPECT_EQ(counts, (std::vector<int>{50, 50}));
}

TEST(SampleSurface, OneSampleLiesOnTheSurface) {
  const std::vector<Vector3d> points = sample_surface(row_of_triangles({1}), 1, 1);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_TRUE(points[0].x() >= 0 && points[0].y() >= 0 && points[0].x() + points[0].y() <= 1);
}

TEST(SampleSurface, ACloudIsReturnedPointByPoint) {
  Mesh cloud = triangles_of({{1, 2, 3}, {4, 5, 6}});
  cloud.triangles.clear();
  EXPECT_EQ(sample_surface(cloud, 1000, 1), (std::vector<Vector3d>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(SampleSurface, AnEmptyMeshHasNoPoints) { EXPECT_TRUE(sample_surface(Mesh{}, 1000, 1).empty()); }

}  // namespace
}  // namespace quorum
