#include "engine/io/image_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/io/file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

class ImageFileTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    write_text(folder_.path() / name, bytes);
    return folder_.path() / name;
  }

  TemporaryFolder folder_;
};

using ImageFile = ImageFileTest;
using MaskFile = ImageFileTest;

ColorImage random_image(int width, int height) {
  std::mt19937 random(7);
  ColorImage image(width, height);
  for (Rgba& pixel : image.values) pixel = make_rgb(random() % 256, random() % 256, random() % 256);
  return image;
}

/// A chunk of a PNG file.
std::string png_chunk(const std::string& type_and_data) {
  std::uint32_t crc = ~0U;
  for (const unsigned char byte : type_and_data) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1U ? 0xedb88320U : 0U);
  }
  const auto big_endian = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  return big_endian(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data + big_endian(~crc);
}

TEST_F(ImageFile, PngReadsBackWhatWasWritten) {
  for (const auto& image : {random_image(37, 23), random_image(1, 1), random_image(1, 50)}) {
    ASSERT_TRUE(write_png(folder_.path() / "a.png", image));
    EXPECT_EQ(read_image(folder_.path() / "a.png").value(), image);
  }
}

TEST_F(ImageFile, RedIsInTheLowestByte) {
  const auto image = read_image(write("a.ppm", "P6 2 1 255\n\x01\x02\x03\xff\x80\x40"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 2);
  EXPECT_EQ(image->at(0, 0), 0xff030201U);
  EXPECT_EQ(image->at(1, 0), make_rgb(255, 128, 64));
}

TEST_F(ImageFile, GrayBecomesColorAndSixteenBitsAreScaled) {
  EXPECT_EQ(read_image(write("a.pgm", "P5 1 1 255\n\x50")).value().at(0, 0), make_rgb(80, 80, 80));
  EXPECT_EQ(read_image(write("b.pgm", "P5 1 1 65535\n\x50\xff")).value().at(0, 0), make_rgb(80, 80, 80));
}

TEST_F(ImageFile, OrientationInTheFileIsIgnored) {
  const ColorImage image = random_image(4, 2);
  ASSERT_TRUE(write_png(folder_.path() / "a.png", image));
  std::string bytes = read_file(folder_.path() / "a.png").value();
  // TIFF header, one entry: tag 0x112 (orientation), type short, count 1, value 6 (turn by 90 degrees).
  const std::string exif("eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 30);
  constexpr std::size_t kAfterHeader = 8 + 25;
  bytes.insert(kAfterHeader, png_chunk(exif));
  EXPECT_EQ(read_image(write("turned.png", bytes)).value(), image);
}

TEST_F(ImageFile, WhatIsNoImageIsNamed) {
  expect_bad_input(read_image(folder_.path() / "none.png"), {"none.png: cannot read: no such file"});
  expect_bad_input(read_image(write("empty.png", "")), {"empty.png: 0 bytes are not an image"});
  expect_bad_input(read_image(write("text.png", "hello")), {"text.png: is damaged or of an unknown kind"});
  expect_bad_input(read_image(folder_.path()), {"is a folder"});
  expect_bad_input(read_mask(write("text.png", "hello")), {"text.png: is damaged"});
  expect_bad_input(read_mask(folder_.path() / "none.png"), {"none.png: cannot read"});
}

TEST_F(ImageFile, TruncatedPngIsRefused) {
  ASSERT_TRUE(write_png(folder_.path() / "a.png", random_image(40, 40)));
  const std::string bytes = read_file(folder_.path() / "a.png").value();
  for (const std::size_t size : {bytes.size() / 2, std::size_t{60}, std::size_t{20}})
    expect_bad_input(read_image(write("cut.png", bytes.substr(0, size))), {"cut.png"});
}

TEST_F(ImageFile, SizeBeyondAllReasonIsRefused) {
  expect_bad_input(read_image(write("huge.pgm", "P5 999999 999999 255\nx")), {"huge.pgm: does not decode"});
}

TEST_F(ImageFile, EmptyImageAndAbsentFolderAreRefused) {
  expect_bad_input(write_png(folder_.path() / "a.png", ColorImage()), {"a.png", "without pixels"});
  expect_bad_input(write_png(folder_.path() / "none" / "a.png", random_image(2, 2)), {"none/a.png: cannot write"});
}

TEST_F(MaskFile, AnyValueAboveZeroTakesPart) {
  EXPECT_EQ(read_mask(write("a.pgm", "P2 4 1 255\n0 1 128 255\n")).value().values,
            (std::vector<std::uint8_t>{0, 1, 1, 1}));
  const std::string sixteen_bits("P5 3 1 65535\n\x00\x00\x00\x01\xff\xff", 19);
  EXPECT_EQ(read_mask(write("b.pgm", sixteen_bits)).value().values, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST_F(MaskFile, ColorCountsByItsGray) {
  const std::string bytes("P6 2 1 255\n\x00\x00\x00\x00\xff\x00", 17);
  EXPECT_EQ(read_mask(write("a.ppm", bytes)).value().values, (std::vector<std::uint8_t>{0, 1}));
}

/// The mask by its definition.
Mask mask_by_definition(const ColorImage& image, double level) {
  const auto neighborhood = [](const Mask& mask, int radius, std::uint8_t wanted, bool outside) {
    Mask result(mask.width, mask.height, !wanted);
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        for (int dy = -radius; dy <= radius; ++dy)
          for (int dx = -radius; dx <= radius; ++dx) {
            if (dx * dx + dy * dy > radius * radius) continue;
            const bool value = mask.contains(x + dx, y + dy) ? mask.at(x + dx, y + dy) != 0 : outside;
            if (value == (wanted != 0)) result.at(x, y) = wanted;
          }
    return result;
  };
  Mask bright(image.width, image.height);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const Rgba pixel = image.values[i];
    bright.values[i] = std::max({red_of(pixel), green_of(pixel), blue_of(pixel)}) > level * 255.0;
  }
  return neighborhood(neighborhood(bright, 10, 1, false), 7, 0, true);
}

TEST(MaskDarkBackground, IsWhatItsDefinitionSays) {
  std::mt19937 random(11);
  for (int round = 0; round < 8; ++round) {
    ColorImage image(70, 50, make_rgb(10, 20, 30));
    for (int i = 0; i < 6; ++i) image.values[random() % image.values.size()] = make_rgb(0, 0, 49 + random() % 4);
    image.at(0, 20) = make_rgb(200, 0, 0);
    const Mask mask = mask_dark_background(image, 0.195);
    EXPECT_EQ(mask, mask_by_definition(image, 0.195));
    EXPECT_NE(std::ranges::count(mask.values, 0), 0);
    EXPECT_NE(std::ranges::count(mask.values, 1), 0);
  }
}

TEST(MaskDarkBackground, SpeckGrowsByThreePixelsAndObjectKeepsTheBorder) {
  ColorImage image(60, 60, make_rgb(0, 0, 0));
  image.at(0, 30) = make_rgb(0, 255, 0);
  const Mask mask = mask_dark_background(image, 0.19);
  EXPECT_EQ(mask.at(0, 30), 1);
  EXPECT_EQ(mask.at(3, 30), 1);
  EXPECT_EQ(mask.at(4, 30), 0);
  EXPECT_EQ(mask.at(0, 27), 1);
  EXPECT_EQ(mask.at(0, 26), 0);
}

TEST(MaskDarkBackground, AllDarkAllBrightAndEmpty) {
  EXPECT_EQ(mask_dark_background(ColorImage(30, 20, make_rgb(9, 9, 9)), 0.1), Mask(30, 20, 0));
  EXPECT_EQ(mask_dark_background(ColorImage(30, 20, make_rgb(0, 0, 90)), 0.1), Mask(30, 20, 1));
  EXPECT_EQ(mask_dark_background(ColorImage(1, 1, make_rgb(0, 0, 90)), 0.1), Mask(1, 1, 1));
  EXPECT_TRUE(mask_dark_background(ColorImage(), 0.1).empty());
}

TEST(MaskDarkBackground, LevelItselfIsBackground) {
  EXPECT_EQ(mask_dark_background(ColorImage(1, 1, make_rgb(51, 0, 0)), 0.2), Mask(1, 1, 0));
  EXPECT_EQ(mask_dark_background(ColorImage(1, 1, make_rgb(52, 0, 0)), 0.2), Mask(1, 1, 1));
}

}  // namespace
}  // namespace quorum
