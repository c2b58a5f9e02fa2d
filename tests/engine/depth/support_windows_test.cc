#include "engine/depth/support_windows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/depth/reference_windows.h"
#include "tests/engine/depth/random_image.h"

namespace quorum {
namespace {

TEST(SupportWindows, AToleranceOf255KeepsWholeWindows) {
  for (const int window : {3, 5, 15}) {
    const PaddedImage image = random_image(41, 33, static_cast<unsigned>(window));
    const auto whole = make_reference_windows(image, window);
    const auto supports = make_support_windows(image, window, 255);
    for (int y = window / 2; y < 33 - window / 2; ++y) {
      for (int x = window / 2; x < 41 - window / 2; ++x) {
        const SupportWindow& support = supports.at(x, y);
        EXPECT_EQ(support.samples, window * window);
        EXPECT_TRUE(std::equal(support.sum, support.sum + 3, whole.at(x, y).sum));
        EXPECT_EQ(support.inverse_deviation, whole.at(x, y).inverse_deviation);
      }
    }
    EXPECT_EQ(supports.at(0, 0).samples, 0);
  }
}

TEST(SupportWindows, OneSideOfAnEdgeIsLeftOut) {
  ColorImage image(21, 11);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 21; ++x) image.at(x, y) = x < 10 ? make_rgb(20, 20 + x, 20) : make_rgb(90, 90 + x % 3, 90);
  const auto supports = make_support_windows(pad_image(image), 5, 15);
  EXPECT_EQ(supports.at(5, 5).samples, 25);
  EXPECT_EQ(supports.at(8, 5).samples, 20);   // columns 6 to 9
  EXPECT_EQ(supports.at(10, 5).samples, 15);  // columns 10 to 12
  EXPECT_EQ(supports.at(10, 5).max_difference, 15);
  double red = 0.0;
  for (int y = 3; y <= 7; ++y)
    for (int x = 10; x <= 12; ++x) red += 90 * 16 - 2048;
  EXPECT_EQ(supports.at(10, 5).sum[0], static_cast<int>(red));
}

TEST(SupportWindows, WhereNothingIsAlikeTheNineOf25MostAlikeStay) {
  for (const auto& [window, least] : {std::pair{3, 4}, {5, 9}, {7, 18}, {15, 81}}) {
    const PaddedImage image = random_image(31, 29, 5);
    const auto supports = make_support_windows(image, window, 0);
    for (int y = window / 2; y < 29 - window / 2; ++y)
      for (int x = window / 2; x < 31 - window / 2; ++x) {
        EXPECT_GE(supports.at(x, y).samples, least);
        EXPECT_LE(supports.at(x, y).samples, least + 6) << "ties alone may add pixels";
      }
  }
}

TEST(SupportWindows, AFlatImageIsItsOwnSupport) {
  const auto supports = make_support_windows(pad_image(ColorImage(9, 9, make_rgb(70, 80, 90))), 5, 15);
  EXPECT_EQ(supports.at(4, 4).samples, 25);
  EXPECT_EQ(supports.at(4, 4).sum[0], 25 * (70 * 16 - 2048));
}

}  // namespace
}  // namespace quorum
