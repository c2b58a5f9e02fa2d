#include "engine/mesh/simplify.h"

#include <gtest/gtest.h>

#include <set>

namespace quorum {
namespace {

/// A square of edge 1 with a square hole in its middle: side * side cells of two triangles, less a fifth by a fifth.
Mesh plate_with_hole(int side) {
  Mesh mesh;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      Vertex vertex;
      vertex.position = Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 0) / static_cast<float>(side);
      vertex.normal = Eigen::Vector3f::UnitZ();
      vertex.confidence = static_cast<float>(x + 1);
      mesh.vertices.push_back(vertex);
    }
  const auto in_hole = [side](int i) { return i >= 2 * side / 5 && i < 3 * side / 5; };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (in_hole(x) && in_hole(y)) continue;
      const auto at = [side](int column, int row) { return static_cast<std::uint32_t>(row * (side + 1) + column); };
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector2f u = (mesh.vertices[b].position - mesh.vertices[a].position).head<2>();
    const Eigen::Vector2f v = (mesh.vertices[c].position - mesh.vertices[a].position).head<2>();
    area += 0.5 * static_cast<double>(u.x() * v.y() - u.y() * v.x());
  }
  return area;
}

TEST(Simplify, AFlatPlateKeepsItsAreaItsHoleAndItsConfidences) {
  const Mesh mesh = plate_with_hole(50);
  double error = 1;
  const Mesh simple = simplify(mesh, {.triangles = 400}, &error);
  EXPECT_LE(simple.triangles.size(), mesh.triangles.size() / 6);
  EXPECT_NEAR(area_of(simple), 0.96, 1e-5);
  EXPECT_LT(error, 1e-4);
  for (const Vertex& vertex : simple.vertices)
    EXPECT_EQ(vertex.confidence, std::round(vertex.position.x() * 50) + 1) << vertex.position.transpose();
}

TEST(Simplify, StopsAtTheWantedNumberOrError) {
  Mesh mesh = plate_with_hole(60);
  for (Vertex& vertex : mesh.vertices) vertex.position.z() = 0.1F * std::sin(6 * vertex.position.x());
  const Mesh half = simplify(mesh, {.triangles = mesh.triangles.size() / 2});
  EXPECT_LE(half.triangles.size(), mesh.triangles.size() / 2);
  EXPECT_GT(half.triangles.size(), mesh.triangles.size() * 2 / 5);
  const std::size_t fine = simplify(mesh, {.error = 1e-5}).triangles.size();
  const std::size_t coarse = simplify(mesh, {.error = 1e-2}).triangles.size();
  EXPECT_LT(coarse, fine);
  EXPECT_LT(fine, mesh.triangles.size());
}

/// A wavy plate in which every third cell of every third row is missing.
Mesh sieve(int side) {
  Mesh mesh = plate_with_hole(side);
  for (Vertex& vertex : mesh.vertices) vertex.position.z() = 0.1F * std::sin(6 * vertex.position.x());
  std::erase_if(mesh.triangles, [side](const auto& triangle) {
    const auto cell = static_cast<int>(triangle[0]);
    return cell % (side + 1) % 3 == 1 && cell / (side + 1) % 3 == 1;
  });
  return mesh;
}

TEST(Simplify, BordersGiveWayWhereTheyWouldTakeTheTrianglesOfTheSurface) {
  const Mesh mesh = sieve(60);
  const std::size_t wanted = mesh.triangles.size() / 6;  // borders alone take more than twice as many
  double error = 1;
  const Mesh simple = simplify(mesh, {.triangles = wanted}, &error);
  EXPECT_LE(simple.triangles.size(), wanted);
  EXPECT_LT(error, 0.02);
  EXPECT_GT(area_of(simple), 0.8);
  EXPECT_LT(area_of(simple), 0.97);  // the hole in the middle is there
}

TEST(Simplify, ACloudStays) {
  Mesh cloud;
  cloud.vertices.resize(3);
  EXPECT_EQ(simplify(cloud, {.triangles = 1}).vertices.size(), 3U);
}

}  // namespace
}  // namespace quorum
