#include "host/sweep_batch.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace quorum {
namespace {

using BlockPlanes = std::map<std::pair<int, int>, std::vector<int>>;

Grid<PlaneRange> random_ranges(int width, int height, unsigned step, unsigned seed) {
  std::mt19937 random(seed);
  Grid<PlaneRange> ranges(width, height, {1, 0});
  for (PlaneRange& range : ranges.values) {
    if (random() % 3 != 0) continue;
    range.first = step * static_cast<uint>(random() % 20);
    range.last = range.first + step * static_cast<uint>(random() % 5);
  }
  return ranges;
}

/// The planes of each block, pixel by pixel.
BlockPlanes tested_planes(const Grid<PlaneRange>& ranges, BlockSize block, int stride) {
  std::map<std::pair<int, int>, std::set<int>> sets;
  for (int y = 0; y < ranges.height; ++y)
    for (int x = 0; x < ranges.width; ++x)
      for (uint plane = ranges.at(x, y).first; plane <= ranges.at(x, y).last; plane += static_cast<uint>(stride))
        sets[{y / block.height * block.height, x / block.width * block.width}].insert(static_cast<int>(plane));
  BlockPlanes planes;
  for (const auto& [place, set] : sets) planes[place].assign(set.begin(), set.end());
  return planes;
}

/// The planes of each block in the order of the batches.
BlockPlanes batched_planes(const Grid<PlaneRange>& ranges, BlockSize size, int stride, int most_items,
                           int most_planes) {
  BlockPlanes planes;
  std::vector<float> inverse_depths(1000);
  for (std::size_t i = 0; i < inverse_depths.size(); ++i) inverse_depths[i] = 0.5F * static_cast<float>(i);
  SweepBatches batches(ranges, inverse_depths, size, stride);
  for (SweepBatch batch = batches.next(most_items, most_planes); !batch.items.empty();
       batch = batches.next(most_items, most_planes)) {
    EXPECT_LE(batch.items.size(), static_cast<std::size_t>(most_items));
    std::set<std::pair<int, int>> places;
    int item_count = 0;
    for (const SweepBlock& block : batch.blocks) {
      EXPECT_TRUE(places.insert({block.y, block.x}).second) << "a block comes twice";
      EXPECT_EQ(block.item_begin, item_count);
      EXPECT_LE(block.item_count, most_planes);
      item_count += block.item_count;
      for (int item = block.item_begin; item < item_count; ++item) {
        const SweepItem& found = batch.items[static_cast<std::size_t>(item)];
        EXPECT_EQ(found.x, block.x);
        EXPECT_EQ(found.y, block.y);
        EXPECT_EQ(found.inverse_depth, 0.5F * static_cast<float>(found.plane));
        planes[{block.y, block.x}].push_back(found.plane);
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(item_count), batch.items.size());
  }
  return planes;
}

TEST(SweepBatches, HoldEachPlaneThatAPixelOfTheBlockTestsOnceAndInOrder) {
  for (const auto& [width, height, block, stride, seed] : {std::tuple{37, 29, BlockSize{8, 8}, 1, 1U},
                                                           {64, 16, BlockSize{16, 16}, 10, 2U},
                                                           {37, 29, BlockSize{4, 2}, 1, 3U},
                                                           {5, 3, BlockSize{8, 8}, 1, 4U},
                                                           {1, 1, BlockSize{4, 4}, 1, 5U}}) {
    const auto ranges = random_ranges(width, height, static_cast<unsigned>(stride), seed);
    EXPECT_EQ(batched_planes(ranges, block, stride, 1 << 20, 1 << 20), tested_planes(ranges, block, stride)) << seed;
  }
}

TEST(SweepBatches, SizesDoNotChangeTheOrderOfPlanes) {
  const auto ranges = random_ranges(37, 29, 1, 5);
  const BlockPlanes planes = tested_planes(ranges, {8, 8}, 1);
  EXPECT_GT(planes.size(), 10U);
  for (const auto& [most_items, most_planes] : {std::pair{1, 1}, {7, 100}, {100, 3}, {1000, 1000}})
    EXPECT_EQ(batched_planes(ranges, {8, 8}, 1, most_items, most_planes), planes) << most_items;
}

TEST(SweepBatches, NothingToTestIsNoBatch) {
  const Grid<PlaneRange> ranges(20, 10, {1, 0});
  EXPECT_TRUE(SweepBatches(ranges, {}, {8, 8}, 1).next(100, 100).items.empty());
  EXPECT_TRUE(SweepBatches(Grid<PlaneRange>(), {}, {8, 8}, 1).next(100, 100).items.empty());
}

}  // namespace
}  // namespace quorum
