#include "engine/depth/reference_windows.h"

#include <gtest/gtest.h>

#include "engine/core/exact.h"
#include "tests/engine/depth/random_image.h"

namespace quorum {
namespace {

ReferenceWindow direct_window(const PaddedImage& image, int window, int x, int y) {
  const int radius = window / 2;
  std::array<std::int64_t, 3> sum = {};
  std::int64_t squares = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Sample sample =
          sample_bilinear(image, (x + dx) * kPositionScale, (y + dy) * kPositionScale, extra_sample_shift(window));
      const std::array<std::int64_t, 3> channels = {sample.red, sample.green, sample.blue};
      for (std::size_t c = 0; c < 3; ++c) sum[c] += channels[c], squares += channels[c] * channels[c];
    }
  }
  const std::int64_t variance =
      std::int64_t{window} * window * squares - (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  return {{static_cast<int>(sum[0]), static_cast<int>(sum[1]), static_cast<int>(sum[2])},
          reciprocal_sqrt(float_from_integer(static_cast<double>(variance)))};
}

TEST(ReferenceWindows, AreTheSumsOfTheirSamples) {
  for (const int window : {3, 5, 15}) {
    const PaddedImage image = random_image(41, 33, static_cast<unsigned>(window));
    const auto windows = make_reference_windows(image, window);
    ASSERT_EQ(windows.width, 41);
    ASSERT_EQ(windows.height, 33);
    for (int y = window / 2; y < 33 - window / 2; ++y) {
      for (int x = window / 2; x < 41 - window / 2; ++x) {
        const ReferenceWindow expected = direct_window(image, window, x, y);
        const ReferenceWindow& found = windows.at(x, y);
        for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(found.sum[c], expected.sum[c]) << x << ' ' << y;
        ASSERT_EQ(found.inverse_deviation, expected.inverse_deviation) << x << ' ' << y;
      }
    }
  }
}

TEST(ReferenceWindows, AnImageSmallerThanTheWindowHasNone) {
  for (const ReferenceWindow& window : make_reference_windows(random_image(4, 3, 1), 5).values)
    EXPECT_EQ(window.inverse_deviation, 0.0F);
  EXPECT_EQ(make_reference_windows(random_image(5, 5, 2), 5).at(1, 2).inverse_deviation, 0.0F);
  EXPECT_GT(make_reference_windows(random_image(5, 5, 2), 5).at(2, 2).inverse_deviation, 0.0F);
}

}  // namespace
}  // namespace quorum
