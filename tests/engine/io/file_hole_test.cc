#include "engine/io/file_hole.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// 300 x 200 pixels of noise; black: the rows from this one on.
ColorImage noise(int black = 200) {
  std::mt19937 random(3);
  ColorImage image(300, 200);
  for (int y = 0; y < black; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y) = make_rgb(random() % 256, random() % 256, random() % 256);
  return image;
}

std::string ppm_of(const ColorImage& image) {
  std::string bytes = "P6\n300 200\n255\n";
  for (const Rgba& pixel : image.values)
    for (const int shift : {0, 8, 16}) bytes += static_cast<char>(pixel >> shift & 0xffU);
  return bytes;
}

std::string bytes_of(const ColorImage& image, const std::string& ending) {
  if (ending == ".ppm") return ppm_of(image);
  const TemporaryFolder folder;
  EXPECT_TRUE(write_image(folder.path() / ("a" + ending), image));
  return read_file(folder.path() / ("a" + ending)).value();
}

std::string with_zeros(std::string bytes, std::size_t begin, std::size_t end) {
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end), '\0');
  return bytes;
}

TEST(FileHole, ZerosOfACopyThatBrokeOffAreToldWithTheFile) {
  const TemporaryFolder folder;
  for (const std::string ending : {".bmp", ".ppm", ".tif", ".webp"}) {
    const std::string whole = bytes_of(noise(), ending);
    ASSERT_GT(whole.size(), 140'000U) << ending;
    const auto path = folder.path() / ("a" + ending);
    write_text(path, whole);
    EXPECT_TRUE(read_image(path)) << ending;
    write_text(path, with_zeros(whole, 81920, 86016));
    expect_bad_input(read_image(path), {"a" + ending, "holds zeros in place of the picture from byte 81920", "copy"});
    write_text(path, with_zeros(whole, 65536, whole.size()));
    EXPECT_FALSE(read_image(path)) << ending;
  }
}

TEST(FileHole, BlackPixelsAreNone) {
  for (const std::string ending : {".bmp", ".ppm", ".tif", ".webp"})
    for (const int black : {0, 1, 60, 120, 199}) EXPECT_FALSE(find_hole(bytes_of(noise(black), ending))) << ending;
  EXPECT_FALSE(find_hole(""));
  EXPECT_FALSE(find_hole(std::string(1 << 20, '\0')));
}

TEST(FileHole, KeepsToTheBlocksOfFileSystems) {
  const std::string whole(40'000, 'x');
  EXPECT_EQ(find_hole(with_zeros(whole, 8192, 12288)), 8192U);
  EXPECT_EQ(find_hole(with_zeros(whole, 8192, 16384)), 8192U);
  EXPECT_EQ(find_hole(with_zeros(with_zeros(whole, 4095, 8192), 16384, 20480)), 16384U) << "begins a byte before";
  EXPECT_FALSE(find_hole(with_zeros(whole, 8192, 12289)));
  EXPECT_FALSE(find_hole(with_zeros(whole, 8192, 12287)));
  EXPECT_FALSE(find_hole(with_zeros(whole, 8192, 40'000)));
  EXPECT_EQ(find_hole(with_zeros(whole + whole, 65536, 80'000)), 65536U);
}

TEST(FileHole, CodesOfWebpAndJpeg2000DoNotEndInZeros) {
  const std::string webp = bytes_of(noise(), ".webp");
  EXPECT_EQ(find_hole(with_zeros(webp, 50'001, webp.size())), 50'001U);
  const std::string box("\0\0\0\x0cjP  \r\n\x87\n\0\0\x10\x08jp2c", 20);
  const std::string codes = "\xff\x4f\xff\x51" + std::string(4090, 'x') + "\xff\xd9" + std::string(4, '\0');
  for (const std::string& whole : {box + codes + std::string(100, '\0'), codes, codes + std::string(100, '\0')}) {
    EXPECT_FALSE(find_hole(whole)) << "zeros behind the end";
    EXPECT_EQ(find_hole(with_zeros(whole, 3000, whole.size())), 3000U);
  }
  EXPECT_FALSE(find_hole(box));
  const std::string begun("RIFF\0\0\0\0WEBPVP8 \xff\xff\xff\xff", 20);
  for (std::size_t size = 0; size <= begun.size(); ++size) EXPECT_FALSE(find_hole(begun.substr(0, size))) << size;
}

}  // namespace
}  // namespace quorum
