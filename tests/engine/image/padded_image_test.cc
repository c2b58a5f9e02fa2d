#include "engine/image/padded_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/layout.h"

namespace quorum {
namespace {

ColorImage random_image(int width, int height) {
  ColorImage image(width, height);
  std::mt19937 random(7);
  for (Rgba& pixel : image.values) pixel = static_cast<Rgba>(random()) | 0xff000000U;
  return image;
}

TEST(PaddedImage, RepeatsTheLastColumnAndRow) {
  const ColorImage image = random_image(3, 2);
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

TEST(SampleBilinear, AgreesWithDoublePrecisionWithinOneSixteenthGrayLevel) {
  const ColorImage image = random_image(17, 13);
  const PaddedImage padded = pad_image(image);
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    const int u = static_cast<int>(random() % static_cast<unsigned>((image.width - 1) * kPositionScale + 1));
    const int v = static_cast<int>(random() % static_cast<unsigned>((image.height - 1) * kPositionScale + 1));
    const double x = u / 256.0;
    const double y = v / 256.0;
    const int column = std::min(static_cast<int>(x), image.width - 2);
    const int row = std::min(static_cast<int>(y), image.height - 2);
    const double fx = x - column;
    const double fy = y - row;
    const auto red = [&](int dx, int dy) { return static_cast<double>(red_of(image.at(column + dx, row + dy))); };
    const double truth =
        (1 - fy) * ((1 - fx) * red(0, 0) + fx * red(1, 0)) + fy * ((1 - fx) * red(0, 1) + fx * red(1, 1));
    const double sample = (sample_bilinear(padded, u, v, 0).red + 2048) / 16.0;
    EXPECT_LE(sample, truth + 1e-9);
    EXPECT_GT(sample, truth - 1.0 / 16.0 - 1e-9);
  }
}

TEST(SampleBilinear, ChannelsDoNotMix) {
  const PaddedImage padded = pad_image(ColorImage(2, 2, make_rgb(10, 100, 200)));
  const Sample sample = sample_bilinear(padded, 77, 133, 0);
  EXPECT_EQ(sample.red, 10 * 16 - 2048);
  EXPECT_EQ(sample.green, 100 * 16 - 2048);
  EXPECT_EQ(sample.blue, 200 * 16 - 2048);
}

TEST(SampleBilinear, SumsOfTheLargestWindowsFitInt) {
  for (int window = 3; window <= 15; window += 2) {
    const double largest = 2048 >> extra_sample_shift(window);
    EXPECT_LT(3.0 * window * window * largest * largest, 2147483648.0) << window;
  }
}

}  // namespace
}  // namespace quorum
