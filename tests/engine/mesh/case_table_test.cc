#include "engine/mesh/case_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "engine/mesh/marching_cubes.h"
#include "tests/support/mesh_measures.h"

namespace quorum {
namespace {

using DirectedEdges = std::map<std::pair<int, int>, int>;

DirectedEdges directed_edges(int cube) {
  DirectedEdges edges;
  for (const auto& triangle : case_table()[static_cast<std::size_t>(cube)])
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  return edges;
}

/// The two ends of a cube edge.
std::pair<int, int> ends(int edge) {
  const CubeEdge& cube_edge = cube_edges()[static_cast<std::size_t>(edge)];
  return {cube_edge.corner, cube_edge.corner | 1 << cube_edge.axis};
}

/// True if one face of the cube holds both edges.
bool in_one_face(int a, int b) {
  const auto [a0, a1] = ends(a);
  const auto [b0, b1] = ends(b);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      if ((a0 >> axis & 1) == side && (a1 >> axis & 1) == side && (b0 >> axis & 1) == side && (b1 >> axis & 1) == side)
        return true;
  return false;
}

TEST(CaseTable, TheTwelveEdgesAreDistinctAndInOrder) {
  std::set<std::pair<int, int>> all;
  for (int edge = 0; edge < 12; ++edge) {
    EXPECT_EQ(cube_edges()[static_cast<std::size_t>(edge)].axis, edge / 4);
    EXPECT_NE(ends(edge).first, ends(edge).second);
    all.insert(ends(edge));
  }
  EXPECT_EQ(all.size(), 12U);
}

TEST(CaseTable, UsesEveryCrossingEdgeAndNoOther) {
  for (int cube = 0; cube < 256; ++cube) {
    std::set<int> used;
    for (const auto& triangle : case_table()[static_cast<std::size_t>(cube)])
      used.insert(triangle.begin(), triangle.end());
    for (int edge = 0; edge < 12; ++edge) {
      const auto [from, to] = ends(edge);
      const bool crossing = (cube >> from & 1) != (cube >> to & 1);
      EXPECT_EQ(used.contains(edge), crossing) << "case " << cube << " edge " << edge;
    }
  }
}

TEST(CaseTable, BordersAreClosedLoopsInTheFaces) {
  for (int cube = 0; cube < 256; ++cube) {
    const DirectedEdges edges = directed_edges(cube);
    std::map<int, int> leaving;
    std::map<int, int> entering;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << "case " << cube;
      if (edges.contains({edge.second, edge.first})) {
        EXPECT_FALSE(in_one_face(edge.first, edge.second)) << "case " << cube << ": a diagonal in a face";
        continue;
      }
      EXPECT_TRUE(in_one_face(edge.first, edge.second)) << "case " << cube << ": a border within the cube";
      ++leaving[edge.first];
      ++entering[edge.second];
    }
    EXPECT_EQ(leaving, entering) << "case " << cube;
    for (const auto& [vertex, count] : leaving) EXPECT_EQ(count, 1) << "case " << cube << " edge " << vertex;
  }
}

TEST(CaseTable, OneCornerInsideGivesOneTriangleThatLooksAway) {
  const auto middle = [](int edge) -> Eigen::Vector3d {
    const auto [from, to] = ends(edge);
    return Eigen::Vector3d((from & 1) + (to & 1), (from >> 1 & 1) + (to >> 1 & 1), (from >> 2) + (to >> 2)) / 2.0;
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d position(corner & 1, corner >> 1 & 1, corner >> 2);
    for (const bool inside : {true, false}) {
      const int cube = inside ? 1 << corner : 255 - (1 << corner);
      const auto& triangles = case_table()[static_cast<std::size_t>(cube)];
      ASSERT_EQ(triangles.size(), 1U);
      const Eigen::Vector3d a = middle(triangles[0][0]);
      const Eigen::Vector3d normal = (middle(triangles[0][1]) - a).cross(middle(triangles[0][2]) - a);
      EXPECT_EQ(normal.dot(a - position) > 0, inside) << "corner " << corner;
    }
  }
  EXPECT_TRUE(case_table()[0].empty());
  EXPECT_TRUE(case_table()[255].empty());
}

/// A pool of 2 x 2 x 2 blocks, all seen and outside but for the voxels 6..9 along each axis, where inside decides.
template <typename Inside>
BlockPool lattice_pool(const VoxelGrid& grid, Inside inside) {
  BlockPool pool;
  for (std::uint32_t index = 0; index < grid.block_count(); ++index) {
    pool.indices.push_back(index);
    const auto [bx, by, bz] = grid.block_position(index);
    for (int voxel = 0; voxel < kBlockVoxels; ++voxel) {
      const int x = bx * 8 + voxel % 8 - 6;
      const int y = by * 8 + voxel / 8 % 8 - 6;
      const int z = bz * 8 + voxel / 64 - 6;
      const bool core = x >= 0 && y >= 0 && z >= 0 && x < 4 && y < 4 && z < 4;
      pool.voxels.push_back({255, core && inside(x, y, z) ? -255 * 1000 : 255 * 1000, {0, 0, 0}});
    }
  }
  return pool;
}

/// How often the mesh goes around a point: 1 inside, 0 outside.
double winding_number(const Mesh& mesh, const Eigen::Vector3d& point) {
  double angle = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[triangle[0]].position.cast<double>() - point;
    const Eigen::Vector3d b = mesh.vertices[triangle[1]].position.cast<double>() - point;
    const Eigen::Vector3d c = mesh.vertices[triangle[2]].position.cast<double>() - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

TEST(CaseTable, RandomSignsGiveAClosedSurfaceAroundTheInsideVoxels) {
  VoxelGrid grid;
  grid.voxel_size = 1.0;
  grid.truncation = 4.0;
  grid.blocks = {2, 2, 2};
  std::set<int> cases;
  for (unsigned seed = 0; seed < 120; ++seed) {
    std::mt19937 random(seed);
    std::array<bool, 64> inside;
    for (bool& value : inside) value = random() % 100 < 20 + seed % 60;
    const auto is_inside = [&](int x, int y, int z) {
      return x >= 0 && y >= 0 && z >= 0 && x < 4 && y < 4 && z < 4 &&
             inside[static_cast<std::size_t>(x + 4 * (y + 4 * z))];
    };
    const Mesh mesh = marching_cubes(lattice_pool(grid, is_inside), grid);
    const MeshMeasures measures = measure_mesh(mesh);
    ASSERT_GT(mesh.triangles.size(), 30U);
    ASSERT_TRUE(measures.closed) << "seed " << seed;
    EXPECT_GT(measures.volume, 0.0);
    for (int z = -1; z <= 4; ++z) {
      for (int y = -1; y <= 4; ++y) {
        for (int x = -1; x <= 4; ++x) {
          ASSERT_NEAR(winding_number(mesh, Eigen::Vector3d(x + 6, y + 6, z + 6)), is_inside(x, y, z) ? 1.0 : 0.0, 1e-3)
              << "seed " << seed << " voxel " << x << " " << y << " " << z;
          int cube = 0;
          for (int corner = 0; corner < 8; ++corner)
            cube |= is_inside(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)) ? 1 << corner : 0;
          cases.insert(cube);
        }
      }
    }
  }
  EXPECT_GT(cases.size(), 250U) << "cases met";
}

}  // namespace
}  // namespace quorum
