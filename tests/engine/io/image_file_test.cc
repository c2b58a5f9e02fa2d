#include "engine/io/image_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <random>

#include "engine/io/file.h"
#include "engine/io/image_size.h"
#include "engine/io/write_image.h"
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

/// A gray file of 16 bits with these values in a row.
std::string deep_gray(const std::vector<int>& values) {
  std::string bytes = "P5 " + std::to_string(values.size()) + " 1 65535\n";
  for (const int value : values) {
    bytes += static_cast<char>(value >> 8);
    bytes += static_cast<char>(value);
  }
  return bytes;
}

TEST_F(ImageFile, TenAndTwelveBitsInSixteenAreTakenByTheirRange) {
  const auto levels = [this](const std::vector<int>& values) {
    const ColorImage image = read_image(write("a.pgm", deep_gray(values))).value();
    std::vector<int> found;
    for (const Rgba pixel : image.values) found.push_back(static_cast<int>(red_of(pixel)));
    return found;
  };
  EXPECT_EQ(levels({0, 4, 513, 1023}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(levels({0, 16, 2048, 4095}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(levels({0, 64, 8192, 16383}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(levels({0, 256, 32768, 65535}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(levels({0, 1, 128, 255}), (std::vector<int>{0, 1, 128, 255})) << "8 bits";
  EXPECT_EQ(levels({30000, 30400, 31000}), (std::vector<int>{0, 102, 255})) << "a narrow range far from 0";
  EXPECT_EQ(levels({7, 7}), (std::vector<int>{7, 7}));
  const auto said = [this](const std::vector<int>& values) {
    return describe_pixel_range(write("a.pgm", deep_gray(values))).value();
  };
  EXPECT_EQ(said({0, 1000}),
            "a.pgm holds values from 0 to 1000: photographs are taken by their own range, this one as of 10 bits");
  EXPECT_EQ(said({30000, 31000}),
            "a.pgm holds values from 30000 to 31000: each photograph is taken by the range of its values");
  EXPECT_EQ(said({0, 60000}), "");
}

TEST_F(MaskFile, AlphaIsTheMaskOfAPhotograph) {
  // 2 x 1, RGBA of 8 bits: opaque red, transparent white.
  const std::string pixels("\0\xff\0\0\xff\xff\xff\xff\0", 9);
  std::uint32_t a = 1, b = 0;
  for (const unsigned char byte : pixels) b = (b + (a = (a + byte) % 65521)) % 65521;
  const std::uint32_t sum = b << 16 | a;
  std::string stored("\x78\x01\x01\x09\0\xf6\xff", 7);
  stored += pixels;
  for (int shift = 24; shift >= 0; shift -= 8) stored += static_cast<char>(sum >> shift);
  const std::string header("IHDR\0\0\0\x02\0\0\0\x01\x08\x06\0\0\0", 17);
  const auto path =
      write("a.png", "\x89PNG\r\n\x1a\n" + png_chunk(header) + png_chunk("IDAT" + stored) + png_chunk("IEND"));
  const auto mask = read_alpha(path);
  ASSERT_TRUE(mask) << mask.error().message;
  EXPECT_EQ(mask->values, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_TRUE(read_image_header(path)->has_alpha);
  ASSERT_TRUE(write_png(path, random_image(2, 1)));
  EXPECT_EQ(read_alpha(path)->values, (std::vector<std::uint8_t>{1, 1})) << "without one";
  EXPECT_FALSE(read_image_header(path)->has_alpha);
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

/// A TIFF file of one channel of floats, a ramp from -10 to 30 along the rows, as thermal cameras write temperatures.
std::string float_tiff(int width, int height) {
  const auto little = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
    return text;
  };
  constexpr std::uint32_t kShort = 3;
  constexpr std::uint32_t kLong = 4;
  const auto pixel_bytes = static_cast<std::uint32_t>(4 * width * height);
  const std::array<std::array<std::uint32_t, 3>, 10> entries = {
      {{256, kLong, static_cast<std::uint32_t>(width)},   // width
       {257, kLong, static_cast<std::uint32_t>(height)},  // height
       {258, kShort, 32},                                 // bits
       {259, kShort, 1},                                  // no compression
       {262, kShort, 1},                                  // black is zero
       {273, kLong, 8},                                   // where the pixels begin
       {277, kShort, 1},                                  // samples a pixel
       {278, kLong, static_cast<std::uint32_t>(height)},  // rows of the strip
       {279, kLong, pixel_bytes},                         // bytes of the strip
       {339, kShort, 3}}};                                // floating point
  std::string file = std::string("II*\0", 4) + little(8 + pixel_bytes, 4);
  for (int i = 0; i < width * height; ++i) {
    const float value = -10.0F + 40.0F * static_cast<float>(i % width) / static_cast<float>(width - 1);
    file += little(std::bit_cast<std::uint32_t>(value), 4);
  }
  file += little(entries.size(), 2);
  for (const auto& [tag, type, value] : entries)
    file += little(tag, 2) + little(type, 2) + little(1, 4) + little(value, 4);
  return file + little(0, 4);
}

TEST_F(ImageFile, FloatsAreTakenByTheirRange) {
  const auto path = write("a.tif", float_tiff(41, 3));
  EXPECT_EQ(read_image_header(path)->bits, 32);
  const auto image = read_image(path);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->at(0, 1), make_rgb(0, 0, 0));
  EXPECT_EQ(image->at(20, 1), make_rgb(128, 128, 128));
  EXPECT_EQ(image->at(40, 2), make_rgb(255, 255, 255));
  EXPECT_NE(describe_pixel_range(path)->find("from -10 to 30"), std::string::npos);
}

}  // namespace
}  // namespace quorum
