#include "engine/volume/carve_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/volume/integrate.h"
#include "engine/volume/range_surface.h"
#include "engine/volume/weigh_surface.h"
#include "tests/engine/volume/plane_input.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kWidth = 81;
constexpr int kHeight = 61;
constexpr double kFocal = 161.37;  // pixels; no voxel lands on the border of a pixel but for those on the axis

/// Before and behind a plane at depth 2.
VoxelGrid make_grid() {
  VoxelGrid grid;
  grid.voxel_size = 0.02;
  grid.truncation = 0.08;
  grid.origin = {-0.6, -0.5, 1.0};
  grid.blocks = {8, 7, 9};
  return grid;
}

std::vector<std::uint32_t> all_blocks(const VoxelGrid& grid) {
  std::vector<std::uint32_t> blocks(grid.block_count());
  std::iota(blocks.begin(), blocks.end(), 0U);
  return blocks;
}

std::vector<BlockBits> carve(const Grid<float>& depth, const Camera& camera, const VoxelGrid& grid,
                             const std::vector<std::uint32_t>& list, SimdLevel simd = best_simd_level()) {
  const FusionOptions options;
  const auto cells = range_surface(depth, make_range_surface_params(camera, depth.width, depth.height, options));
  const auto weights = weigh_surface(depth, Grid<float>(depth.width, depth.height, 1.0F), cells,
                                     make_weigh_surface_params(camera, depth.width, depth.height, options));
  std::vector<BlockBits> empty(grid.block_count());
  carve_blocks({depth, cells, weights}, list, make_integrate_params(camera, depth.width, depth.height, grid), simd,
               empty);
  return empty;
}

/// Calls visit(position, is_empty) for all voxels.
template <typename Visit>
void for_each(const VoxelGrid& grid, const std::vector<BlockBits>& empty, Visit visit) {
  for (std::uint32_t index = 0; index < empty.size(); ++index) {
    const auto [bx, by, bz] = grid.block_position(index);
    for (int voxel = 0; voxel < kBlockVoxels; ++voxel) {
      const Eigen::Vector3d at(bx * 8 + voxel % 8, by * 8 + voxel / 8 % 8, bz * 8 + voxel / 64);
      visit(Eigen::Vector3d(grid.origin + grid.voxel_size * at),
            (empty[index][static_cast<std::size_t>(voxel) / 64] >> (voxel % 64) & 1) != 0);
    }
  }
}

TEST(CarveBlocks, VoxelsBeforeASurfaceAreEmptyUpToTheTruncation) {
  const Camera camera = straight_camera(kWidth, kHeight, kFocal);
  const VoxelGrid grid = make_grid();
  int before = 0;
  int others = 0;
  for_each(grid, carve(Grid<float>(kWidth, kHeight, 2.015F), camera, grid, all_blocks(grid)),
           [&](const Eigen::Vector3d& position, bool is_empty) {
             const Eigen::Vector3d pixel = camera.project(position);
             const bool visible = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < kWidth - 1 && pixel.y() < kHeight - 1;
             const double distance = 2.015 - position.z();  // along the normal
             EXPECT_EQ(is_empty, visible && distance > grid.truncation) << position.transpose();
             ++(is_empty ? before : others);
           });
  EXPECT_GT(before, 20000);
  EXPECT_GT(others, 20000);
}

TEST(CarveBlocks, BackgroundEmptiesTheWholeLineOfSightAndNoDepthNothing) {
  const Camera camera = straight_camera(kWidth, kHeight, kFocal);
  const VoxelGrid grid = make_grid();
  Grid<float> depth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) depth.at(x, y) = kBackgroundDepth;
  int background = 0;
  for_each(grid, carve(depth, camera, grid, all_blocks(grid)), [&](const Eigen::Vector3d& position, bool is_empty) {
    const Eigen::Vector3d pixel = camera.project(position);
    const bool within = pixel.x() >= 0 && pixel.y() >= 0 && pixel.y() < kHeight - 1 && pixel.x() < kWidth / 2 - 1;
    if (std::abs(pixel.x() - (kWidth / 2 - 1)) < 1e-3) return;
    EXPECT_EQ(is_empty, within) << position.transpose();
    background += is_empty ? 1 : 0;
  });
  EXPECT_GT(background, 10000);
}

TEST(CarveBlocks, ACameraInTheGridCarvesNothingBehindItself) {
  const Camera camera = straight_camera(kWidth, kHeight, kFocal);
  VoxelGrid grid = make_grid();
  grid.origin.z() = -0.7;
  int empty_voxels = 0;
  for_each(grid, carve(Grid<float>(kWidth, kHeight, kBackgroundDepth), camera, grid, all_blocks(grid)),
           [&](const Eigen::Vector3d& position, bool is_empty) {
             if (!is_empty) return;
             ++empty_voxels;
             EXPECT_GT(position.z(), 0.0);
           });
  EXPECT_GT(empty_voxels, 1000);
}

TEST(CarveBlocks, BlocksInSightHoldAllThatIsEmptyAndFewMore) {
  const Camera camera = straight_camera(kWidth, kHeight, kFocal);
  Grid<float> half = plane_depth(camera, kWidth, kHeight, 2.0, 35.0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) half.at(x, y) = 0.0F;
  Grid<float> masked = half;
  masked.at(3, 3) = masked.at(4, 3) = masked.at(3, 4) = masked.at(4, 4) = kBackgroundDepth;
  for (const double origin : {1.0, -0.7}) {
    VoxelGrid grid = make_grid();
    grid.origin.z() = origin;
    for (const Grid<float>& depth : {half, masked}) {
      const auto list = blocks_in_sight(depth, camera, grid);
      const auto empty = carve(depth, camera, grid, all_blocks(grid));
      EXPECT_EQ(carve(depth, camera, grid, list), empty);
      EXPECT_TRUE(std::ranges::is_sorted(list));
      EXPECT_LT(list.size(), grid.block_count() * 2 / 3);
      EXPECT_GT(list.size(), 20U);
    }
  }
}

TEST(CarveBlocks, InstructionsDoNotChangeTheBits) {
  const SphereScene sphere = make_sphere_scene(3, kWidth, kHeight, true, 1);
  FusionOptions options;
  options.voxel_size = 0.1;
  const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
  const View& view = sphere.scene.views[1];
  Grid<float> depth(kWidth, kHeight, kBackgroundDepth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (const double d = sphere_depth(view, x, y); d > 0) depth.at(x, y) = static_cast<float>(d);
  const auto expected = carve(depth, view.camera, grid, all_blocks(grid), SimdLevel::kBaseline);
  EXPECT_GT(std::ranges::count_if(expected, [](const BlockBits& bits) { return bits != BlockBits{}; }), 10);
  for (const SimdLevel simd : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (simd > best_simd_level()) continue;
    EXPECT_EQ(carve(depth, view.camera, grid, all_blocks(grid), simd), expected) << static_cast<int>(simd);
  }
}

}  // namespace
}  // namespace quorum
