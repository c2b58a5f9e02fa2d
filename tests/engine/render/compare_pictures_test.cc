#include "engine/render/compare_pictures.h"

#include <gtest/gtest.h>

#include <random>

namespace quorum {
namespace {

ColorImage noise(unsigned seed) {
  std::mt19937 random(seed);
  ColorImage image(20, 20);
  for (Rgba& pixel : image.values) pixel = make_rgb(random() % 256, random() % 256, random() % 256);
  return image;
}

TEST(ComparePictures, EqualOnesAreAsLikeAsCanBe) {
  const PictureLikeness like = compare_pictures(noise(1), noise(1), Mask(20, 20, 1));
  EXPECT_EQ(like.pixels, 400U);
  EXPECT_EQ(like.psnr, 99);
  EXPECT_NEAR(like.ssim, 1, 1e-12);
}

TEST(ComparePictures, ADifferenceOfAllPixelsGivesItsRatio) {
  const ColorImage dark(20, 20, make_rgb(100, 100, 100));
  const ColorImage light(20, 20, make_rgb(110, 110, 110));
  EXPECT_NEAR(compare_pictures(dark, light, Mask(20, 20, 1)).psnr, 20 * std::log10(25.5), 1e-9);
  EXPECT_LT(compare_pictures(noise(1), noise(2), Mask(20, 20, 1)).ssim, 0.2);
}

TEST(ComparePictures, WhatIsNotSeenDoesNotCount) {
  ColorImage other = noise(1);
  Mask where(20, 20, 1);
  other.at(3, 4) ^= 0xffU;
  where.at(3, 4) = 0;
  const PictureLikeness like = compare_pictures(noise(1), other, where);
  EXPECT_EQ(like.pixels, 399U);
  EXPECT_EQ(like.psnr, 99);
  EXPECT_EQ(compare_pictures(noise(1), other, Mask(20, 20)).pixels, 0U);
}

}  // namespace
}  // namespace quorum
