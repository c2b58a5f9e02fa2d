#include "engine/mesh/fill_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/mesh/filled_patches.h"
#include "tests/support/mesh_measures.h"

namespace quorum {
namespace {

VoxelGrid make_grid() {
  VoxelGrid grid;
  grid.voxel_size = 1.0;
  grid.truncation = 3.0;
  grid.blocks = {4, 4, 4};
  return grid;
}

/// A ball of radius 9 in a lattice of 32 x 32 x 32. Voxels within 3 of its surface were measured with this weight, as
/// long as measured(position) is true.
template <typename Measured>
MeasuredSurface measure_ball(std::int32_t weight, Measured measured) {
  const VoxelGrid grid = make_grid();
  BlockPool pool;
  for (std::uint32_t index = 0; index < grid.block_count(); ++index) {
    pool.indices.push_back(index);
    const auto [bx, by, bz] = grid.block_position(index);
    for (int voxel = 0; voxel < kBlockVoxels; ++voxel) {
      const Eigen::Vector3d at(bx * 8 + voxel % 8, by * 8 + voxel / 8 % 8, bz * 8 + voxel / 64);
      const double distance = (at - Eigen::Vector3d::Constant(15.3)).norm() - 9.0;
      const bool near = std::abs(distance) <= 3.0 && measured(at);
      const auto value = static_cast<std::int32_t>(distance / 3.0 * kDistanceScale);
      pool.voxels.push_back(near ? Voxel{weight, weight * value, {weight * 200, weight * 100, weight * 50}} : Voxel{});
    }
  }
  MarchingCubes cubes(grid, true);
  cubes.add(pool, pool.indices.size());
  return cubes.take();
}

/// The voxels of which the predicate is true.
template <typename Predicate>
EmptySpace empty_where(Predicate is_empty) {
  const VoxelGrid grid = make_grid();
  EmptySpace empty;
  for (std::uint32_t index = 0; index < grid.block_count(); ++index) {
    const auto [bx, by, bz] = grid.block_position(index);
    BlockBits& bits = empty.voxels.emplace_back();
    for (int voxel = 0; voxel < kBlockVoxels; ++voxel)
      if (is_empty(Eigen::Vector3d(bx * 8 + voxel % 8, by * 8 + voxel / 8 % 8, bz * 8 + voxel / 64)))
        bits[static_cast<std::size_t>(voxel) / 64] |= 1ULL << (voxel % 64);
  }
  return empty;
}

double radius(const Eigen::Vector3d& at) { return (at - Eigen::Vector3d::Constant(15.3)).norm(); }
bool below_cap(const Eigen::Vector3d& at) { return at.z() < 21.0; }

bool beside_ball(const Eigen::Vector3d& at) { return radius(at) > 10.0; }

EmptySpace before_background(EmptySpace empty) {
  empty.beyond_grid = true;
  return empty;
}

std::int64_t count_filled(const Mesh& mesh) { return std::ranges::count_if(mesh.vertices, is_filled); }

TEST(FillHoles, AMissingCapIsClosedWhereEmptySpaceEnds) {
  FilledSurface surface(measure_ball(255, below_cap), before_background(empty_where(beside_ball)), 0.0F);
  const std::size_t vertex_count = surface.vertex_count();
  const Mesh mesh = surface.finish();
  EXPECT_EQ(mesh.vertices.size(), vertex_count);
  const MeshMeasures measures = measure_mesh(mesh);
  EXPECT_TRUE(measures.closed);
  EXPECT_EQ(measures.euler_characteristic, 2);
  EXPECT_GT(count_filled(mesh), 100);
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_EQ(vertex.color, make_rgb(200, 100, 50)) << "filled vertices take the colors around";
    const Eigen::Vector3d position = vertex.position.cast<double>();
    EXPECT_EQ(is_filled(vertex), vertex.confidence < 1.0F);
    if (!is_filled(vertex)) {
      EXPECT_NEAR(radius(position), 9.0, 0.1);
      continue;
    }
    EXPECT_GT(position.z(), 19.0);
    EXPECT_LT(radius(position), 10.5);
    EXPECT_GT(radius(position), 5.0) << "a membrane over the hole is not lower than its rim";
  }
}

TEST(FillHoles, WhatReachesTheBorderOfTheGridIsNoHole) {
  // Empty on one side of a wall through the ball that no view saw beyond, up to the borders.
  const auto half = [](const Eigen::Vector3d& at) { return at.x() < 12.0 && radius(at) > 10.0; };
  const auto measured = [](const Eigen::Vector3d& at) { return at.x() < 12.5; };
  const Mesh open = FilledSurface(measure_ball(255, measured), empty_where(half), 0.0F).finish();
  EXPECT_EQ(count_filled(open), 0);
  EXPECT_GT(open.triangles.size(), 500U);
  // With a background, what lies beyond the grid is known.
  const Mesh closed = FilledSurface(measure_ball(255, measured), before_background(empty_where(half)), 0.0F).finish();
  EXPECT_TRUE(measure_mesh(closed).closed);
  EXPECT_GT(count_filled(closed), 1000);
}

TEST(FillHoles, WithoutABackgroundOnlySmallHolesAreFilled) {
  const Mesh open = FilledSurface(measure_ball(255, below_cap), empty_where(beside_ball), 0.0F).finish();
  EXPECT_EQ(count_filled(open), 0);
  EXPECT_FALSE(measure_mesh(open).closed);
  const auto but_one_column = [](const Eigen::Vector3d& at) {
    return at.x() < 24.5 || std::abs(at.y() - 15.0) > 0.5 || std::abs(at.z() - 15.0) > 0.5;
  };
  const Mesh closed = FilledSurface(measure_ball(255, but_one_column), empty_where(beside_ball), 0.0F).finish();
  EXPECT_GT(count_filled(closed), 0);
  EXPECT_LE(100 * count_filled(closed), static_cast<std::int64_t>(closed.vertices.size()));
  EXPECT_TRUE(measure_mesh(closed).closed);
}

TEST(FillHoles, AWeakSurfaceInEmptySpaceIsCarvedAwayAndAStrongOneStays) {
  const auto everywhere = [](const Eigen::Vector3d&) { return true; };
  const Mesh strong = FilledSurface(measure_ball(255, everywhere), empty_where(everywhere), 0.5F).finish();
  EXPECT_EQ(count_filled(strong), 0);
  EXPECT_GT(strong.triangles.size(), 1000U);
  const Mesh weak = FilledSurface(measure_ball(100, everywhere), empty_where(everywhere), 0.5F).finish();
  EXPECT_TRUE(weak.vertices.empty());
  EXPECT_TRUE(weak.triangles.empty());
}

TEST(FillHoles, AWeakSurfaceThatNoViewLooksThroughIsFilledIn) {
  const auto everywhere = [](const Eigen::Vector3d&) { return true; };
  const auto cap_is_weak = [&](std::int32_t weight) {
    MeasuredSurface surface = measure_ball(255, everywhere);
    const MeasuredSurface weak = measure_ball(weight, everywhere);
    for (std::size_t place = 0; place < surface.weights.size(); ++place)
      if (place / kBlockVoxels / 16 >= 2) surface.weights[place] = weak.weights[place];
    for (Vertex& vertex : surface.vertices)
      if (vertex.position.z() >= 16.0F) vertex.confidence = static_cast<float>(weight) / 255.0F;
    return FilledSurface(std::move(surface), before_background(empty_where(beside_ball)), 0.5F).finish();
  };
  EXPECT_EQ(count_filled(cap_is_weak(200)), 0);
  const Mesh mesh = cap_is_weak(100);
  EXPECT_TRUE(measure_mesh(mesh).closed);
  EXPECT_GT(count_filled(mesh), 500);
  for (const Vertex& vertex : mesh.vertices) EXPECT_TRUE(is_filled(vertex) || vertex.confidence >= 0.5F);
}

TEST(FillHoles, NothingMeasuredGivesNothing) {
  const auto nowhere = [](const Eigen::Vector3d&) { return false; };
  const Mesh mesh = FilledSurface(measure_ball(255, nowhere), empty_where(beside_ball), 0.0F).finish();
  EXPECT_TRUE(mesh.vertices.empty());
}

TEST(SmoothFilled, MeasuredVerticesStayAndFilledOnesSettleBetweenThem) {
  Mesh mesh;
  mesh.vertices.resize(9);
  for (std::size_t place = 0; place < mesh.vertices.size(); ++place) {
    Vertex& vertex = mesh.vertices[place];
    vertex.position = Eigen::Vector3f(static_cast<float>(place / 3), static_cast<float>(place % 3), 0.0F);
    vertex.color = make_rgb(10, 20, 30);
    vertex.confidence = 1.0F;
  }
  mesh.vertices[4].position.z() = 7.0F;
  mesh.vertices[4].color = make_rgb(128, 128, 128);
  mesh.vertices[4].confidence = 0.0F;
  mesh.triangles = {{0, 3, 4}, {0, 4, 1}, {1, 4, 2}, {2, 4, 5}, {3, 6, 4}, {4, 6, 7}, {4, 7, 8}, {4, 8, 5}};
  const Mesh before = mesh;
  smooth_filled(mesh, 1);
  EXPECT_EQ(mesh.vertices[4].position, Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(mesh.vertices[4].color, make_rgb(10, 20, 30));
  EXPECT_EQ(mesh.vertices[4].confidence, 0.0F);
  for (const std::size_t vertex : {0U, 1U, 2U, 3U, 5U, 6U, 7U, 8U})
    EXPECT_EQ(mesh.vertices[vertex].position, before.vertices[vertex].position);
}

}  // namespace
}  // namespace quorum
