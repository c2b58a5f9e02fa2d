#include "engine/volume/slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace quorum {
namespace {

VoxelGrid grid_of_slabs() {
  VoxelGrid grid;
  grid.blocks = {7, 5, 6};
  return grid;
}

/// Every third block or so.
std::vector<std::uint32_t> some_blocks(const VoxelGrid& grid) {
  std::mt19937 random(5);
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t index = 0; index < grid.block_count(); ++index)
    if (random() % 3 == 0) blocks.push_back(index);
  return blocks;
}

TEST(Slabs, TogetherHoldEachBlockOnceInOrder) {
  const VoxelGrid grid = grid_of_slabs();
  const auto blocks = some_blocks(grid);
  for (const std::size_t most : {std::size_t{4}, std::size_t{9}, std::size_t{30}, blocks.size()}) {
    std::vector<std::uint32_t> cores;
    while (cores.size() < blocks.size()) {
      const Slab slab = make_slab(blocks, cores.size(), blocks.size(), grid, most);
      ASSERT_GT(slab.core_count, 0U);
      ASSERT_LE(slab.blocks.size(), most);
      ASSERT_TRUE(std::ranges::is_sorted(slab.blocks));
      cores.insert(cores.end(), slab.blocks.begin(),
                   slab.blocks.begin() + static_cast<std::ptrdiff_t>(slab.core_count));
    }
    EXPECT_EQ(cores, blocks);
  }
}

TEST(Slabs, HoldTheStoredNeighborsOfTheirCoreAlongEachAxis) {
  const VoxelGrid grid = grid_of_slabs();
  const auto blocks = some_blocks(grid);
  const Slab slab = make_slab(blocks, 10, blocks.size(), grid, 30);
  ASSERT_LT(slab.core_count, 30U);
  std::vector<std::uint32_t> expected(slab.blocks.begin(),
                                      slab.blocks.begin() + static_cast<std::ptrdiff_t>(slab.core_count));
  for (std::size_t i = 0; i < slab.core_count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto position = grid.block_position(slab.blocks[i]);
      if (++position[axis] == grid.blocks[axis]) continue;
      const std::uint32_t index = grid.block_index(position[0], position[1], position[2]);
      if (std::ranges::binary_search(blocks, index)) expected.push_back(index);
    }
  }
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(slab.blocks, expected);
}

TEST(Slabs, OneHoldsAllWhereThereIsRoom) {
  const VoxelGrid grid = grid_of_slabs();
  const auto blocks = some_blocks(grid);
  EXPECT_EQ(make_slab(blocks, 0, blocks.size(), grid, blocks.size()).blocks, blocks);
  EXPECT_EQ(make_slab(blocks, 0, blocks.size(), grid, blocks.size()).core_count, blocks.size());
  EXPECT_LT(make_slab(blocks, 0, blocks.size(), grid, blocks.size() - 1).core_count, blocks.size() - 1);
  EXPECT_TRUE(make_slab(blocks, blocks.size(), blocks.size(), grid, 4).blocks.empty());
  EXPECT_TRUE(make_slab({}, 0, 0, grid, 4).blocks.empty());
}

}  // namespace
}  // namespace quorum
