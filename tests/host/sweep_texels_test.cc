#include "host/sweep_texels.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

/// Each pixel tells its place.
PaddedImage numbered_image(int width, int height) {
  PaddedImage image{width, height, {}};
  for (int y = 0; y <= height; ++y)
    for (int x = 0; x <= width; ++x) image.pixels.push_back(static_cast<Rgba>(1000 * y + x + 1));
  return image;
}

TEST(SweepTexels, AQuadIsAPixelWithItsRightAndLowerNeighbors) {
  const PaddedImage image = numbered_image(3, 2);
  const auto quads = make_quads(image);
  ASSERT_EQ(quads.size(), 6U);
  EXPECT_EQ(quads_size(image), 6U * 16U);
  EXPECT_EQ(quads[0], (Texel{1, 2, 1001, 1002}));
  EXPECT_EQ(quads[5], (Texel{1003, 1004, 2003, 2004}));
}

TEST(SweepTexels, TheReferenceIsShiftedByTheRadiusAndReachesOverTheLastBlocks) {
  const PaddedImage image = numbered_image(10, 9);
  const auto texels = make_reference_texels(image, 5);
  const int stride = reference_texels_stride(10, 5);
  EXPECT_EQ(stride, 5);  // 16 + 4 columns
  ASSERT_EQ(texels.size(), static_cast<std::size_t>(stride * (16 + 4)));
  const auto row = static_cast<std::size_t>(stride);
  EXPECT_EQ(texels[0], Texel{});
  EXPECT_EQ(texels[2 * row], (Texel{0, 0, 1, 2}));
  EXPECT_EQ(texels[3 * row + 1], (Texel{1003, 1004, 1005, 1006}));
  EXPECT_EQ(texels[10 * row + 2], (Texel{8007, 8008, 8009, 8010}));
  EXPECT_EQ(texels[11 * row + 2], Texel{});
}

TEST(SweepTexels, WholeBlocksKeepTheGrid) {
  Grid<int> grid(9, 3, 7);
  const Grid<int> blocks = in_whole_blocks(grid);
  EXPECT_EQ(blocks.width, 16);
  EXPECT_EQ(blocks.height, 16);
  EXPECT_EQ(blocks.at(8, 2), 7);
  EXPECT_EQ(blocks.at(9, 2), 0);
  EXPECT_EQ(blocks.at(0, 3), 0);
}

}  // namespace
}  // namespace quorum
