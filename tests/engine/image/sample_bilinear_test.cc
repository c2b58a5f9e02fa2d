#include "engine/image/sample_bilinear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "engine/image/padded_image.h"

namespace quorum {
namespace {

ColorImage random_image(int width, int height) {
  ColorImage image(width, height);
  std::mt19937 random(7);
  for (Rgba& pixel : image.values) pixel = static_cast<Rgba>(random()) | 0xff000000U;
  return image;
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

/// A channel of the sample as one writes it down, without words that channels share.
int plain_sample(const std::array<std::uint32_t, 4>& channel, int u, int v, int shift) {
  const int x = u % kPositionScale;
  const int y = v % kPositionScale;
  const auto value = [&](std::size_t i) { return static_cast<int>(channel[i]); };
  const int top = value(0) * (kPositionScale - x) + value(1) * x;
  const int bottom = value(2) * (kPositionScale - x) + value(3) * x;
  return ((top * (kPositionScale - y) + bottom * y) >> shift) - (1 << (23 - shift));
}

TEST(SampleBilinear, EveryChannelIsThePlainOne) {
  std::mt19937 random(5);
  for (int i = 0; i < 5000; ++i) {
    std::array<Rgba, 4> texels = {};
    for (Rgba& texel : texels)
      texel = i % 3 == 0 ? (random() % 2 == 0 ? 0xffffffffU : 0U) : static_cast<Rgba>(random());
    const int u = static_cast<int>(random() % 2560);
    const int v = static_cast<int>(random() % 2560);
    const int shift = kSampleShift + i % 2;
    const auto plain = [&](auto channel_of) {
      return plain_sample({channel_of(texels[0]), channel_of(texels[1]), channel_of(texels[2]), channel_of(texels[3])},
                          u, v, shift);
    };
    const Sample sample = sample_bilinear(texels[0], texels[1], texels[2], texels[3], u, v, shift);
    ASSERT_EQ(sample.red, plain(red_of));
    ASSERT_EQ(sample.green, plain(green_of));
    ASSERT_EQ(sample.blue, plain(blue_of));
  }
}

TEST(SampleBilinear, APixelIsTheSampleAtItsCenter) {
  const PaddedImage padded = pad_image(random_image(9, 7));
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 9; ++x) {
      const Sample pixel = sample_pixel(padded.at(x, y), kSampleShift);
      const Sample sample = sample_bilinear(padded, x * kPositionScale, y * kPositionScale, 0);
      EXPECT_EQ(pixel.red, sample.red);
      EXPECT_EQ(pixel.green, sample.green);
      EXPECT_EQ(pixel.blue, sample.blue);
    }
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

TEST(LargestDifference, IsThatOfTheChannelThatDiffersMost) {
  EXPECT_EQ(largest_difference(make_rgb(10, 20, 30), make_rgb(10, 20, 30)), 0);
  EXPECT_EQ(largest_difference(make_rgb(10, 20, 30), make_rgb(15, 18, 30)), 5);
  EXPECT_EQ(largest_difference(make_rgb(10, 20, 30), make_rgb(15, 0, 30)), 20);
  EXPECT_EQ(largest_difference(make_rgb(0, 0, 255), make_rgb(0, 0, 0) & 0xffffffU), 255);
}

}  // namespace
}  // namespace quorum
