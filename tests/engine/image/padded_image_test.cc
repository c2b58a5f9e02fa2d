#include "engine/image/padded_image.h"

#include <gtest/gtest.h>

#include <random>

namespace quorum {
namespace {

ColorImage random_colors(int width, int height) {
  ColorImage image(width, height);
  std::mt19937 random(7);
  for (Rgba& pixel : image.values) pixel = static_cast<Rgba>(random()) | 0xff000000U;
  return image;
}

TEST(PaddedImage, RepeatsTheLastColumnAndRow) {
  const ColorImage image = random_colors(3, 2);
  const PaddedImage padded = pad_image(image);
  EXPECT_EQ(padded.pixels.size(), 4U * 3U);
  EXPECT_EQ(padded.at(2, 1), image.at(2, 1));
  EXPECT_EQ(padded.at(3, 0), image.at(2, 0));
  EXPECT_EQ(padded.at(1, 2), image.at(1, 1));
  EXPECT_EQ(padded.at(3, 2), image.at(2, 1));
}

TEST(PaddedImage, OnePixelIsPaddedToo) {
  const PaddedImage padded = pad_image(ColorImage(1, 1, make_rgb(1, 2, 3)));
  EXPECT_EQ(padded.pixels, std::vector<Rgba>(4, make_rgb(1, 2, 3)));
}

}  // namespace
}  // namespace quorum
