#include "engine/io/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace quorum {
namespace {

constexpr Rgba kRed = make_rgb(200, 0, 0);
constexpr Rgba kGreen = make_rgb(0, 200, 0);
constexpr Rgba kWhite = make_rgb(255, 255, 255);

std::ptrdiff_t count_of(const ColorImage& image, Rgba color) { return std::ranges::count(image.values, color); }

TEST(ContactSheet, ShowsEveryPictureWholeInRows) {
  const ColorImage red(20, 10, kRed);
  const ColorImage green(8, 16, kGreen);
  const ColorImage sheet = contact_sheet({{red, ""}, {green, ""}, {red, ""}}, 2);
  EXPECT_EQ(count_of(sheet, kRed), 2 * 20 * 10);
  EXPECT_EQ(count_of(sheet, kGreen), 8 * 16);
  EXPECT_EQ(count_of(sheet, kRed) + count_of(sheet, kGreen) + count_of(sheet, kWhite), sheet.width * sheet.height);
  const auto first_row = [&](int y) { return std::ranges::count(sheet.row(y), sheet.row(y) + sheet.width, kGreen); };
  int top = 0;
  while (first_row(top) == 0) ++top;
  EXPECT_LT(top, sheet.height / 2) << "the second picture stands in the first row";
  EXPECT_EQ(contact_sheet({{red, ""}, {green, ""}, {red, ""}}, 3).height * 2, sheet.height + 6);
}

TEST(ContactSheet, WritesTheCaptionBelowItsPicture) {
  const ColorImage red(120, 10, kRed);
  const ColorImage plain = contact_sheet({{red, ""}}, 1);
  const ColorImage captioned = contact_sheet({{red, "5 x 5, depth"}}, 1);
  ASSERT_EQ(captioned.width, plain.width);
  EXPECT_EQ(count_of(captioned, kRed), 1200);
  EXPECT_LT(count_of(captioned, kWhite), count_of(plain, kWhite) - 50);
}

TEST(ContactSheet, EmptyPicturesLeaveTheirPlaceWhite) {
  EXPECT_TRUE(contact_sheet({}, 3).empty());
  const ColorImage sheet = contact_sheet({{ColorImage(5, 5, kRed), ""}, {{}, ""}}, 2);
  EXPECT_EQ(count_of(sheet, kRed), 25);
}

TEST(Crop, IsCutToTheImage) {
  ColorImage image(6, 4);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<Rgba>(i);
  const ColorImage part = crop(image, 2, 1, 3, 2);
  EXPECT_EQ(part.values, (std::vector<Rgba>{8, 9, 10, 14, 15, 16}));
  EXPECT_EQ(crop(image, 4, 3, 10, 10).values, (std::vector<Rgba>{22, 23}));
  EXPECT_EQ(crop(image, -5, -5, 100, 100), image);
  EXPECT_TRUE(crop(image, 9, 9, 3, 3).empty());
}

TEST(TurnLeft, BringsTheRightSideUp) {
  ColorImage image(3, 2);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<Rgba>(i);
  const ColorImage turned = turn_left(image, 1);
  EXPECT_EQ(turned.width, 2);
  EXPECT_EQ(turned.values, (std::vector<Rgba>{2, 5, 1, 4, 0, 3}));
  EXPECT_EQ(turn_left(turned, 3), image);
  EXPECT_EQ(turn_left(image, 0), image);
}

TEST(ScaleToWidth, KeepsProportionsAndMeans) {
  ColorImage image(8, 4, make_rgb(0, 0, 0));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; x += 2) image.at(x, y) = make_rgb(100, 200, 60);
  const ColorImage half = scale_to_width(image, 4);
  EXPECT_EQ(half.height, 2);
  for (const Rgba pixel : half.values) EXPECT_EQ(pixel & 0xffffffU, make_rgb(50, 100, 30) & 0xffffffU);
  EXPECT_TRUE(scale_to_width({}, 4).empty());
}

}  // namespace
}  // namespace quorum
