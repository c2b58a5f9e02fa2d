#include "engine/io/preview.h"

#include <gtest/gtest.h>

#include <limits>

namespace quorum {
namespace {

constexpr Rgba kBlack = make_rgb(0, 0, 0);
constexpr Rgba kTurboLow = make_rgb(48, 18, 59);
constexpr Rgba kTurboHigh = make_rgb(122, 4, 3);

TEST(ColorMapDepth, GoesFromNearToFarAndLeavesNoDepthBlack) {
  Grid<float> depth(5, 1);
  depth.values = {0.0F, 0.5F, 0.75F, 1.0F, std::numeric_limits<float>::infinity()};
  const ColorImage image = color_map_depth(depth);
  EXPECT_EQ(image.at(0, 0), kBlack);
  EXPECT_EQ(image.at(1, 0), kTurboLow);
  EXPECT_GT(green_of(image.at(2, 0)), 200U);
  EXPECT_EQ(image.at(3, 0), kTurboHigh);
  EXPECT_EQ(image.at(4, 0), kBlack);
}

TEST(ColorMapDepth, OneOutlierInAHundredDoesNotStretchTheColors) {
  Grid<float> depth(201, 1);
  for (int x = 0; x < 200; ++x) depth.at(x, 0) = 1.0F + static_cast<float>(x) / 200.0F;
  depth.at(200, 0) = 1e6F;
  const ColorImage image = color_map_depth(depth);
  EXPECT_EQ(image.at(200, 0), kTurboHigh);
  EXPECT_EQ(image.at(199, 0), kTurboHigh);
  EXPECT_EQ(image.at(0, 0), kTurboLow);
  EXPECT_GT(green_of(image.at(100, 0)), 200U);
}

TEST(ColorMapDepth, EmptyMapsAndOneDepth) {
  EXPECT_TRUE(color_map_depth(Grid<float>()).empty());
  EXPECT_EQ(color_map_depth(Grid<float>(3, 2)), ColorImage(3, 2, kBlack));
  EXPECT_EQ(color_map_depth(Grid<float>(3, 2, 0.6F)), ColorImage(3, 2, kTurboLow));
}

TEST(ColorMapUnit, IsGrayAndClamped) {
  Grid<float> map(6, 1);
  map.values = {0.0F, 0.5F, 1.0F, -1.0F, 7.0F, std::numeric_limits<float>::quiet_NaN()};
  const ColorImage image = color_map_unit(map);
  EXPECT_EQ(image.values, (std::vector<Rgba>{kBlack, make_rgb(128, 128, 128), make_rgb(255, 255, 255), kBlack,
                                             make_rgb(255, 255, 255), kBlack}));
  EXPECT_TRUE(color_map_unit(Grid<float>()).empty());
}

}  // namespace
}  // namespace quorum
