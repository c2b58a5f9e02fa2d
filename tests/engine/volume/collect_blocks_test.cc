#include "engine/volume/collect_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/engine/volume/plane_input.h"

namespace quorum {
namespace {

constexpr int kCollectWidth = 81;
constexpr int kCollectHeight = 61;

VoxelGrid grid_to_collect() {
  VoxelGrid grid;
  grid.voxel_size = 0.02;
  grid.truncation = 0.08;
  grid.origin = {-0.6, -0.5, 1.0};
  grid.blocks = {8, 7, 12};
  return grid;
}

std::vector<std::uint32_t> collect(const Grid<float>& depth, std::uint32_t weight) {
  const Camera camera = straight_camera(kCollectWidth, kCollectHeight, 160);
  return block_indices(collect_blocks(depth, Grid<std::uint32_t>(kCollectWidth, kCollectHeight, weight),
                                      make_collect_params(camera, kCollectWidth, kCollectHeight, grid_to_collect())));
}

TEST(CollectBlocks, EveryVoxelWithinTheTruncationLiesInACollectedBlock) {
  const Camera camera = straight_camera(kCollectWidth, kCollectHeight, 160);
  const VoxelGrid grid = grid_to_collect();
  for (const double angle : {0.0, 35.0, 60.0}) {
    const auto depth = plane_depth(camera, kCollectWidth, kCollectHeight, 2.0, angle);
    const auto blocks = collect(depth, 100);
    const double slope = std::tan(angle * std::numbers::pi / 180.0);
    int near_count = 0;
    for (std::uint32_t index = 0; index < grid.block_count(); ++index) {
      const auto [bx, by, bz] = grid.block_position(index);
      const bool collected = std::ranges::binary_search(blocks, index);
      for (int voxel = 0; voxel < kBlockVoxels; ++voxel) {
        const Eigen::Vector3d position =
            grid.origin +
            grid.voxel_size * Eigen::Vector3d(bx * 8 + voxel % 8, by * 8 + voxel / 8 % 8, bz * 8 + voxel / 64);
        const Eigen::Vector3d pixel = camera.project(position);
        if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > kCollectWidth - 1 || pixel.y() > kCollectHeight - 1) continue;
        const double on_ray = 2.0 / (1.0 - slope * position.x() / position.z());
        const double distance = (on_ray - position.z()) * position.norm() / position.z();
        if (std::abs(distance) > grid.truncation) continue;
        ++near_count;
        ASSERT_TRUE(collected) << angle << " degrees, voxel at " << position.transpose();
      }
    }
    EXPECT_GT(near_count, 5000);
  }
}

TEST(CollectBlocks, FarBlocksAreNotCollected) {
  const VoxelGrid grid = grid_to_collect();
  const auto blocks = collect(Grid<float>(kCollectWidth, kCollectHeight, 2.0F), 100);
  const double block_size = kBlockSide * grid.voxel_size;
  EXPECT_GT(blocks.size(), 50U);
  EXPECT_LT(blocks.size(), grid.block_count() / 2);
  for (const std::uint32_t index : blocks) {
    const double low = grid.origin.z() + block_size * grid.block_position(index)[2];
    EXPECT_GT(low + block_size, 2.0 - grid.truncation - 0.5 * block_size);
    EXPECT_LT(low, 2.0 + grid.truncation + 0.5 * block_size);
  }
}

TEST(CollectBlocks, OnePixelCollectsTheBlocksAroundItsPoint) {
  const VoxelGrid grid = grid_to_collect();
  Grid<std::uint32_t> weights(kCollectWidth, kCollectHeight);
  weights.at(40, 30) = 1;  // on the axis
  const auto blocks = block_indices(collect_blocks(
      Grid<float>(kCollectWidth, kCollectHeight, 2.0F), weights,
      make_collect_params(straight_camera(kCollectWidth, kCollectHeight, 160), kCollectWidth, kCollectHeight, grid)));
  const auto at = [](double position, double origin) { return static_cast<int>((position - origin) / 0.16); };
  EXPECT_TRUE(std::ranges::binary_search(blocks, grid.block_index(at(0, -0.6), at(0, -0.5), at(2.0, 1.0))));
  EXPECT_LE(blocks.size(), 27U);
}

TEST(CollectBlocks, WithoutWeightNothingIsCollected) {
  EXPECT_TRUE(collect(Grid<float>(kCollectWidth, kCollectHeight, 2.0F), 0).empty());
}

TEST(CollectBlocks, WildDepthsCollectNothingOutsideTheBounds) {
  EXPECT_TRUE(collect(Grid<float>(kCollectWidth, kCollectHeight, 1e9F), 255).empty());
  EXPECT_TRUE(collect(Grid<float>(kCollectWidth, kCollectHeight, 1e-9F), 255).empty());
  EXPECT_TRUE(collect(Grid<float>(kCollectWidth, kCollectHeight, 3.4e38F), 255).empty());
  std::mt19937 random(1);
  Grid<float> depth(kCollectWidth, kCollectHeight);
  for (float& value : depth.values)
    value = static_cast<float>(std::pow(10.0, std::uniform_real_distribution<double>(-6, 30)(random)));
  for (const std::uint32_t index : collect(depth, 255)) EXPECT_LT(index, grid_to_collect().block_count());
}

TEST(BlockIndices, AreTheSetBitsInAscendingOrder) {
  EXPECT_EQ(block_indices({0b101, 0, 0x80000000U, 1}), (std::vector<std::uint32_t>{0, 2, 95, 96}));
  EXPECT_TRUE(block_indices({}).empty());
  EXPECT_TRUE(block_indices({0, 0}).empty());
}

}  // namespace
}  // namespace quorum
