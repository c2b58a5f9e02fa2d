#include "engine/io/tiff_flaw.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

struct Kind {
  int compression = COMPRESSION_NONE;
  int bits = 8;
  bool separate = false;  ///< a plane for each channel
  bool tiled = false;
};

constexpr int kTiffWidth = 200;
constexpr int kTiffHeight = 160;

/// The bytes of a file of noise, in strips of 16 rows or tiles of 32 x 16.
std::string tiff_of(const Kind& kind) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.tif";
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFOpen(path.c_str(), "w"), &TIFFClose);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, kTiffWidth);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, kTiffHeight);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, kind.bits);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, kind.separate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, kind.compression);
  if (kind.tiled) TIFFSetField(tiff.get(), TIFFTAG_TILEWIDTH, 32);
  TIFFSetField(tiff.get(), kind.tiled ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP, 16);
  const auto size = static_cast<std::size_t>(kind.tiled ? TIFFTileSize(tiff.get()) : TIFFStripSize(tiff.get()));
  std::mt19937 random(3);
  std::vector<unsigned char> values(size);
  const std::uint32_t pieces = kind.tiled ? TIFFNumberOfTiles(tiff.get()) : TIFFNumberOfStrips(tiff.get());
  for (std::uint32_t piece = 0; piece < pieces; ++piece) {
    for (unsigned char& value : values) value = static_cast<unsigned char>(random() % 64);  // something to compress
    const auto write = kind.tiled ? TIFFWriteEncodedTile : TIFFWriteEncodedStrip;
    EXPECT_GT(write(tiff.get(), piece, values.data(), static_cast<tmsize_t>(size)), 0);
  }
  EXPECT_EQ(TIFFFlush(tiff.get()), 1);
  return read_file(path).value();
}

/// The same with the picture, in strips, once more behind the directory, which then tells of that one: libtiff writes
/// the directory last, cameras write it first.
std::string with_directory_first(const std::string& bytes) {
  const auto number = [&bytes](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
  };
  const std::uint32_t directory = number(4);
  std::string moved = bytes;
  const std::size_t entries = static_cast<unsigned char>(bytes[directory]);
  const std::size_t by = bytes.size() - 8;
  for (std::size_t entry = 0; entry < entries; ++entry) {
    const std::size_t at = directory + 2 + 12 * entry;
    const std::uint32_t tag = number(at) & 0xffffU;
    if (tag != TIFFTAG_STRIPOFFSETS) continue;
    for (std::size_t strip = 0; strip < number(at + 4); ++strip) {
      const std::size_t place = number(at + 8) + 4 * strip;
      const auto offset = static_cast<std::uint32_t>(number(place) + by);
      for (std::size_t i = 0; i < 4; ++i) moved[place + i] = static_cast<char>(offset >> (8 * i));
    }
  }
  return moved + bytes.substr(8, directory - 8);
}

TEST(TiffFlaw, WholeFilesOfAllKindsHaveNone) {
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
    for (const int bits : {8, 16})
      for (const bool separate : {false, true})
        for (const bool tiled : {false, true})
          EXPECT_FALSE(find_tiff_flaw(tiff_of({compression, bits, separate, tiled})))
              << compression << " " << bits << " " << separate << " " << tiled;
  for (const char* other : {"", "II", "II*", "MM", "no TIFF file"}) EXPECT_FALSE(find_tiff_flaw(other)) << other;
  EXPECT_FALSE(find_tiff_flaw(std::string("II*\0\xff\xff\xff\xff", 8))) << "decoders fail";
}

TEST(TiffFlaw, OneThatWasCutOffIsRefusedNotFilledWithBlack) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.tif";
  const std::string whole = with_directory_first(tiff_of({}));
  write_text(path, whole);
  ASSERT_TRUE(read_image(path));
  constexpr std::size_t kStrip = 3 * 16 * kTiffWidth;
  for (const std::size_t strips : {1U, 5U}) {
    const std::string cut = whole.substr(0, whole.size() - strips * kStrip + 1);
    const auto flaw = find_tiff_flaw(cut);
    ASSERT_TRUE(flaw);
    EXPECT_EQ(flaw->row, kTiffHeight - 16 * static_cast<int>(strips));
    EXPECT_EQ(flaw->height, kTiffHeight);
    write_text(path, cut);
    expect_bad_input(read_image(path),
                     {"a.tif", fmt::format("from about row {} of 160 on", flaw->row), "copy it again"});
  }
}

TEST(TiffFlaw, DamageWithinCompressedOnesIsToldWithItsRow) {
  for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
    for (const bool tiled : {false, true}) {
      const std::string whole = tiff_of({compression, 8, false, tiled});
      for (const double place : {0.25, 0.5, 0.75}) {
        std::mt19937 random(7);
        std::string damaged = whole;
        const auto at = static_cast<std::size_t>(place * static_cast<double>(whole.size()));
        for (std::size_t i = at; i < at + 256; ++i) damaged[i] = static_cast<char>(random());
        const auto flaw = find_tiff_flaw(damaged);
        ASSERT_TRUE(flaw) << compression << " " << tiled << " " << place;
        EXPECT_NEAR(flaw->row, place * kTiffHeight, 20) << compression << " " << tiled;
      }
    }
  }
}

}  // namespace
}  // namespace quorum
