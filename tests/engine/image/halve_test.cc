#include "engine/image/halve.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(HalveImage, TakesTheRoundedMeanOfFour) {
  ColorImage image(5, 3, make_rgb(99, 99, 99));
  image.at(0, 0) = make_rgb(0, 10, 255);
  image.at(1, 0) = make_rgb(1, 10, 255);
  image.at(0, 1) = make_rgb(0, 10, 255);
  image.at(1, 1) = make_rgb(1, 12, 254);
  const ColorImage half = halve_image(image);
  EXPECT_EQ(half.width, 2);
  EXPECT_EQ(half.height, 1);
  EXPECT_EQ(half.at(0, 0), make_rgb(1, 11, 255));  // 0.5, 10.5 and 254.75
  EXPECT_EQ(half.at(1, 0), make_rgb(99, 99, 99));
}

TEST(HalveMask, KeepsWhatAllFourKeep) {
  Mask mask(4, 2, 1);
  mask.at(3, 1) = 0;
  EXPECT_EQ(halve_mask(mask).values, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_TRUE(halve_mask({}).empty());
}

}  // namespace
}  // namespace quorum
