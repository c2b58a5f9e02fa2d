#include "engine/depth/tile_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace quorum {
namespace {

constexpr int kWindow = 5;
constexpr PlaneRange kNone{1, 0};

TilePlanes collect(const Grid<PlaneRange>& ranges, const Tile& tile, int stride) {
  TilePlanes result;
  result.collect(ranges, tile, stride, kWindow);
  return result;
}

/// How many of the parts on a plane hold each pixel of the view.
Grid<int> covered(const TilePlanes& tile_planes, int plane, int width, int height) {
  Grid<int> count(width, height);
  for (const auto& [part_plane, part] : tile_planes.planes())
    if (part_plane == plane)
      for (int y = part.y; y < part.y_end; ++y)
        for (int x = part.x; x < part.x_end; ++x) ++count.at(x, y);
  return count;
}

TEST(TilePlanes, EveryPixelIsInOnePartOfEachPlaneThatItTests) {
  std::mt19937 random(1);
  TilePlanes tile_planes;
  for (const Tile& tile : {Tile{3, 2, 67, 18}, {0, 0, 64, 64}, {5, 7, 12, 8}, {10, 10, 11, 11}, {20, 30, 52, 70}}) {
    for (const int stride : {1, 10}) {
      Grid<PlaneRange> ranges(80, 70, kNone);
      std::uint64_t tests = 0;
      for (int y = 0; y < ranges.height; ++y) {
        for (int x = 0; x < ranges.width; ++x) {
          if (random() % 3 == 0) continue;
          const auto first = static_cast<std::uint32_t>((x / 9 + y / 6) % 4 * 20) + (random() % 2 == 0 ? 10U : 0U);
          const auto last = first + static_cast<std::uint32_t>(random() % 19);
          ranges.at(x, y) = {first, last};
          if (x >= tile.x && x < tile.x_end && y >= tile.y && y < tile.y_end)
            tests += (last - first) / static_cast<std::uint32_t>(stride) + 1;
        }
      }
      tile_planes.collect(ranges, tile, stride, kWindow);
      EXPECT_EQ(tile_planes.tests(), tests);
      EXPECT_TRUE(std::ranges::is_sorted(tile_planes.planes(), {}, &TilePlane::plane));
      for (int plane = 0; plane < 100; ++plane) {
        const Grid<int> count = covered(tile_planes, plane, ranges.width, ranges.height);
        for (int y = 0; y < ranges.height; ++y) {
          for (int x = 0; x < ranges.width; ++x) {
            const bool in_tile = x >= tile.x && x < tile.x_end && y >= tile.y && y < tile.y_end;
            const PlaneRange& range = ranges.at(x, y);
            const auto index = static_cast<std::uint32_t>(plane);
            const bool tested = in_tile && plane % stride == 0 && index >= range.first && index <= range.last;
            ASSERT_LE(count.at(x, y), in_tile ? 1 : 0) << "plane " << plane << " (" << x << ", " << y << ")";
            ASSERT_TRUE(!tested || count.at(x, y) == 1) << "plane " << plane << " (" << x << ", " << y << ")";
          }
        }
      }
    }
  }
}

TEST(TilePlanes, AWholeTileIsOnePart) {
  const TilePlanes result = collect(Grid<PlaneRange>(64, 16, {4, 5}), {0, 0, 64, 16}, 1);
  ASSERT_EQ(result.planes().size(), 2U);
  EXPECT_EQ(result.planes()[0].plane, 4);
  EXPECT_EQ(result.planes()[1].plane, 5);
  EXPECT_EQ(result.planes()[0].part.x_end - result.planes()[0].part.x, 64);
  EXPECT_EQ(result.planes()[0].part.y_end - result.planes()[0].part.y, 16);
  EXPECT_EQ(result.samples(kWindow), 2U * 68 * 20);
}

TEST(TilePlanes, PixelsFarApartAreSweptApart) {
  Grid<PlaneRange> ranges(64, 32, kNone);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) ranges.at(x, y) = ranges.at(60 + x, y) = ranges.at(30 + x, 28 + y) = {7, 7};
  const TilePlanes result = collect(ranges, {0, 0, 64, 32}, 1);
  EXPECT_EQ(result.planes().size(), 3U);
  EXPECT_EQ(result.samples(kWindow), 3U * 8 * 8);
}

TEST(TilePlanes, ATileThatTestsNothingHasNone) {
  const TilePlanes result = collect(Grid<PlaneRange>(20, 20, kNone), {0, 0, 20, 20}, 1);
  EXPECT_TRUE(result.planes().empty());
  EXPECT_EQ(result.tests(), 0U);
  EXPECT_EQ(result.samples(kWindow), 0U);
}

}  // namespace
}  // namespace quorum
