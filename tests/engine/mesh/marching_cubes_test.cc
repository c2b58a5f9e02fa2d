#include "engine/mesh/marching_cubes.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/volume/slabs.h"
#include "tests/support/mesh_measures.h"

namespace quorum {
namespace {

constexpr double kVoxel = 0.1;
constexpr double kTruncation = 0.4;
constexpr double kRadius = 0.93;
const Eigen::Vector3d kCenter(2.213, 1.157, -0.391);

/// A lattice of 4 x 3 x 3 blocks around the sphere.
VoxelGrid cubes_grid() {
  VoxelGrid grid;
  grid.voxel_size = kVoxel;
  grid.truncation = kTruncation;
  grid.origin = {1.0, 0.0, -1.55};
  grid.blocks = {4, 3, 3};
  return grid;
}

/// Voxels of weight 255 within the truncation of the sphere; voxel (x, y, z) is unseen if unseen(x, y, z). Color: the
/// coordinates along the lattice in units of 8. Blocks without a seen voxel are not stored.
template <typename Unseen>
BlockPool sphere_pool(const VoxelGrid& grid, Unseen unseen) {
  BlockPool pool;
  for (std::uint32_t index = 0; index < grid.block_count(); ++index) {
    const auto [bx, by, bz] = grid.block_position(index);
    std::vector<Voxel> block(kBlockVoxels);
    bool any = false;
    for (int local = 0; local < kBlockVoxels; ++local) {
      const int x = bx * 8 + local % 8;
      const int y = by * 8 + local / 8 % 8;
      const int z = bz * 8 + local / 64;
      const Eigen::Vector3d position = grid.origin + kVoxel * Eigen::Vector3d(x, y, z);
      const double distance = ((position - kCenter).norm() - kRadius) / kTruncation;
      if (std::abs(distance) > 1.0 || unseen(x, y, z)) continue;
      int value = static_cast<int>(std::lround(distance * kDistanceScale));
      if (value == 0) value = 1;
      block[static_cast<std::size_t>(local)] = {255, 255 * value, {255 * 8 * x, 255 * 8 * y, 255 * 8 * z}};
      any = true;
    }
    if (!any) continue;
    pool.indices.push_back(index);
    pool.voxels.insert(pool.voxels.end(), block.begin(), block.end());
  }
  return pool;
}

bool seen_everywhere(int, int, int) { return false; }

TEST(MarchingCubes, ASphereIsClosedWithItsAreaAndVolume) {
  const VoxelGrid grid = cubes_grid();
  const BlockPool pool = sphere_pool(grid, seen_everywhere);
  ASSERT_GT(pool.indices.size(), 20U);
  const Mesh mesh = marching_cubes(pool, grid);
  const MeshMeasures measures = measure_mesh(mesh);
  EXPECT_TRUE(measures.closed);
  EXPECT_EQ(measures.euler_characteristic, 2);
  const double area = 4.0 * std::numbers::pi * kRadius * kRadius;
  const double volume = area * kRadius / 3.0;
  EXPECT_NEAR(measures.area, area, 0.01 * area);
  EXPECT_NEAR(measures.volume, volume, 0.01 * volume);
}

TEST(MarchingCubes, VerticesLieOnTheSphereWithOutwardNormals) {
  const VoxelGrid grid = cubes_grid();
  const Mesh mesh = marching_cubes(sphere_pool(grid, seen_everywhere), grid);
  ASSERT_GT(mesh.vertices.size(), 1000U);
  for (const Vertex& vertex : mesh.vertices) {
    const Eigen::Vector3d offset = vertex.position.cast<double>() - kCenter;
    EXPECT_NEAR(offset.norm(), kRadius, 0.02 * kVoxel);
    EXPECT_NEAR(vertex.normal.norm(), 1.0F, 1e-5F);
    EXPECT_GT(vertex.normal.cast<double>().dot(offset.normalized()), 0.98);
  }
}

TEST(MarchingCubes, ColorAndConfidenceAreInterpolated) {
  const VoxelGrid grid = cubes_grid();
  BlockPool pool = sphere_pool(grid, seen_everywhere);
  const Mesh mesh = marching_cubes(pool, grid);
  for (const Vertex& vertex : mesh.vertices) {
    const Eigen::Vector3d lattice = (vertex.position.cast<double>() - grid.origin) / kVoxel;
    EXPECT_NEAR(red_of(vertex.color), 8 * lattice.x(), 0.51);
    EXPECT_NEAR(green_of(vertex.color), 8 * lattice.y(), 0.51);
    EXPECT_NEAR(blue_of(vertex.color), 8 * lattice.z(), 0.51);
    EXPECT_FLOAT_EQ(vertex.confidence, 1.0F);
  }
  // Twice the weight inside: the same surface, and confidence between 1 and 2 by the place on the edge.
  for (Voxel& voxel : pool.voxels) {
    if (voxel.distance >= 0) continue;
    voxel.weight *= 2;
    voxel.distance *= 2;
    for (std::int32_t& channel : voxel.color) channel *= 2;
  }
  const Mesh uneven = marching_cubes(pool, grid);
  ASSERT_EQ(uneven.vertices.size(), mesh.vertices.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(uneven.vertices[i].position, mesh.vertices[i].position);
    EXPECT_EQ(uneven.vertices[i].color, mesh.vertices[i].color);
    EXPECT_GT(uneven.vertices[i].confidence, 1.0F);
    EXPECT_LT(uneven.vertices[i].confidence, 2.0F);
    sum += uneven.vertices[i].confidence;
  }
  EXPECT_NEAR(sum / static_cast<double>(mesh.vertices.size()), 1.5, 0.05);
}

TEST(MarchingCubes, AnEmptyPoolGivesAnEmptyMesh) {
  const Mesh none = marching_cubes({}, cubes_grid());
  EXPECT_TRUE(none.vertices.empty());
  EXPECT_TRUE(none.triangles.empty());
  BlockPool unseen;
  unseen.indices = {3};
  unseen.voxels.resize(kBlockVoxels);
  EXPECT_TRUE(marching_cubes(unseen, cubes_grid()).vertices.empty());
  for (Voxel& voxel : unseen.voxels) voxel = {255, 255, {}};  // all outside
  EXPECT_TRUE(marching_cubes(unseen, cubes_grid()).vertices.empty());
}

TEST(MarchingCubes, OneVoxelInsideGivesAnOctahedron) {
  BlockPool pool;
  pool.indices = {0};
  pool.voxels.assign(kBlockVoxels, {255, 255 * 100, {}});
  pool.voxels[3 + 8 * 4 + 64 * 5].distance = -255 * 100;
  VoxelGrid grid = cubes_grid();
  grid.origin.setZero();
  grid.voxel_size = 1.0;
  const Mesh mesh = marching_cubes(pool, grid);
  EXPECT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.triangles.size(), 8U);
  const MeshMeasures measures = measure_mesh(mesh);
  EXPECT_TRUE(measures.closed);
  EXPECT_NEAR(measures.volume, 4.0 / 3.0 * 0.125, 1e-6);
  for (const Vertex& vertex : mesh.vertices)
    EXPECT_NEAR((vertex.position - Eigen::Vector3f(3, 4, 5)).norm(), 0.5F, 1e-6F);
}

TEST(MarchingCubes, UnseenVoxelsLeaveHolesAndNoTriangleTouchesThem) {
  const VoxelGrid grid = cubes_grid();
  const auto unseen = [](int x, int y, int z) { return (x * 73 + y * 179 + z * 283) % 97 == 0; };
  const BlockPool pool = sphere_pool(grid, unseen);
  const Mesh mesh = marching_cubes(pool, grid);
  const Mesh whole = marching_cubes(sphere_pool(grid, seen_everywhere), grid);
  EXPECT_LT(mesh.triangles.size(), whole.triangles.size() * 97 / 100);
  EXPECT_GT(mesh.triangles.size(), whole.triangles.size() * 3 / 4);
  EXPECT_FALSE(measure_mesh(mesh).closed);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t corner : triangle) {
      middle += mesh.vertices[corner].position.cast<double>() / 3.0;
      used[corner] = true;
    }
    const Eigen::Vector3d cube = (middle - grid.origin) / kVoxel;
    for (int corner = 0; corner < 8; ++corner)
      EXPECT_FALSE(unseen(static_cast<int>(cube.x()) + (corner & 1), static_cast<int>(cube.y()) + (corner >> 1 & 1),
                          static_cast<int>(cube.z()) + (corner >> 2)));
  }
  EXPECT_EQ(std::ranges::count(used, false), 0) << "vertices without a triangle";
}

TEST(MarchingCubes, AMissingBlockLeavesAHole) {
  const VoxelGrid grid = cubes_grid();
  BlockPool pool = sphere_pool(grid, seen_everywhere);
  const Mesh whole = marching_cubes(pool, grid);
  pool.indices.erase(pool.indices.begin() + 4);
  pool.voxels.erase(pool.voxels.begin() + 4 * kBlockVoxels, pool.voxels.begin() + 5 * kBlockVoxels);
  const Mesh mesh = marching_cubes(pool, grid);
  EXPECT_LT(mesh.triangles.size(), whole.triangles.size());
  EXPECT_GT(mesh.triangles.size(), whole.triangles.size() / 2);
}

TEST(MarchingCubes, PartsGiveTheMeshOfTheWhole) {
  const VoxelGrid grid = cubes_grid();
  const BlockPool pool = sphere_pool(grid, [](int x, int y, int z) { return (x * 31 + y * 17 + z * 7) % 101 == 0; });
  const Mesh whole = marching_cubes(pool, grid);
  for (const std::size_t most : {4U, 7U, 15U}) {
    MarchingCubes cubes(grid);
    for (std::size_t first = 0; first < pool.indices.size();) {
      const Slab slab = make_slab(pool.indices, first, pool.indices.size(), grid, most);
      BlockPool part{slab.blocks, {}};
      for (const std::uint32_t block : slab.blocks) {
        const auto place = std::ranges::find(pool.indices, block) - pool.indices.begin();
        const auto voxels = pool.voxels.begin() + place * kBlockVoxels;
        part.voxels.insert(part.voxels.end(), voxels, voxels + kBlockVoxels);
      }
      cubes.add(part, slab.core_count);
      first += slab.core_count;
    }
    EXPECT_TRUE(same_mesh(cubes.finish(), whole)) << most;
  }
}

TEST(MarchingCubes, ThreadsDoNotChangeTheBytes) {
  const VoxelGrid grid = cubes_grid();
  const BlockPool pool = sphere_pool(grid, [](int x, int y, int z) { return (x * 31 + y * 17 + z * 7) % 101 == 0; });
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return marching_cubes(pool, grid);
  };
  const Mesh one = with_threads(1);
  const Mesh two = with_threads(2);
  EXPECT_TRUE(same_mesh(one, two));
  EXPECT_GT(one.triangles.size(), 1000U);
}

}  // namespace
}  // namespace quorum
