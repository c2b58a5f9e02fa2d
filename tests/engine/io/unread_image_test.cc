#include "engine/io/unread_image.h"

#include <algorithm>
#include <random>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/image_size.h"
#include "engine/io/jpeg_flaw.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

ColorImage gradient() {
  ColorImage image(64, 48);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = make_rgb(static_cast<std::uint32_t>(4 * x), static_cast<std::uint32_t>(5 * y), 90);
  return image;
}

TEST(UnreadImage, WhatOtherLibrariesWouldDecodeIsNotHandedToThem) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  // GDCM, which OpenCV asks, ends the process over this.
  write_text(path, std::string("\x89P\x9c\x9c", 4) + std::string(124, '\0') + "DICM" + std::string("\x0b\0\0", 3));
  expect_bad_input(read_image(path), {"a.png", "unknown kind of image"});
  expect_bad_input(read_image_size(path), {"a.png"});
  write_text(path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\1\1\1\1");
  expect_bad_input(read_image(path), {"a.png", "unknown kind of image"});
}

TEST(UnreadImage, AJpegThatWasCutOffIsRefusedNotFilledWithGray) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  const std::string whole = encode_jpeg(gradient(), 90).value();
  write_text(path, whole);
  EXPECT_TRUE(read_image(path));
  write_text(path, whole + std::string(100, '\0'));
  EXPECT_TRUE(read_image(path)) << "some cameras write more behind the picture";
  for (const std::size_t bytes : {whole.size() - 12, whole.size() * 3 / 4}) {
    write_text(path, whole.substr(0, bytes));
    expect_bad_input(read_image(path), {"a.jpg", "ends too early", "copy it again"});
    expect_bad_input(is_jpeg_without_end(path), {"a.jpg", "ends too early"});
  }
  write_text(path, whole.substr(0, whole.size() * 3 / 4) + std::string(whole.size() / 4, '\0'));
  expect_bad_input(read_image(path), {"a.jpg", "ends too early"});
}

TEST(UnreadImage, AJpegThatLacksTheMarkerOfItsEndAloneIsTaken) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  const std::string whole = encode_jpeg(gradient(), 90).value();
  write_text(path, whole);
  const ColorImage expected = read_image(path).value();
  EXPECT_FALSE(is_jpeg_without_end(path).value());
  write_text(path, whole.substr(0, whole.size() - 2));
  const auto image = read_image(path);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(*image, expected);
  EXPECT_TRUE(is_jpeg_without_end(path).value());
  EXPECT_FALSE(is_jpeg_without_end(folder.path() / "none.jpg").value());
}

TEST(UnreadImage, DamageWithinAJpegIsToldWithItsRow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  std::mt19937 random(3);
  ColorImage photograph(640, 480);
  for (Rgba& pixel : photograph.values) pixel = make_rgb(random() % 256, random() % 256, random() % 256);
  const std::string whole = encode_jpeg(photograph, 90).value();
  for (const double place : {0.25, 0.5, 0.75}) {
    std::string damaged = whole;
    const auto at = static_cast<std::size_t>(place * static_cast<double>(whole.size()));
    for (std::size_t i = at; i < at + 64; ++i) damaged[i] = static_cast<char>(random());
    write_text(path, damaged);
    expect_bad_input(read_image(path), {"a.jpg", "is damaged within the picture", "copy it again"});
    const JpegFlaw flaw = find_jpeg_flaw(damaged);
    EXPECT_EQ(flaw.kind, JpegFlaw::Kind::kDamaged);
    EXPECT_EQ(flaw.height, 480);
    EXPECT_GE(flaw.row, 480 * place - 16);
  }
  std::string hole = whole;  // as file systems leave it
  std::fill_n(hole.begin() + static_cast<std::ptrdiff_t>(hole.size() / 2), 4096, '\0');
  write_text(path, hole);
  expect_bad_input(read_image(path), {"is damaged"});
}

TEST(UnreadImage, WhatCamerasWriteBesideThePictureIsNoDamage) {
  const std::string whole = encode_jpeg(gradient(), 90).value();
  EXPECT_EQ(find_jpeg_flaw(whole).kind, JpegFlaw::Kind::kNone);
  const std::string padded = whole.substr(0, whole.size() - 2) + std::string(100, '\0') + "\xff\xd9";
  EXPECT_EQ(find_jpeg_flaw(padded).kind, JpegFlaw::Kind::kNone) << "zeros before the end";
  EXPECT_EQ(find_jpeg_flaw(whole + "a film").kind, JpegFlaw::Kind::kNone);
  EXPECT_EQ(find_jpeg_flaw("no JPEG file").kind, JpegFlaw::Kind::kNone);
  EXPECT_EQ(find_jpeg_flaw(whole.substr(0, 100)).kind, JpegFlaw::Kind::kNone) << "decoders fail";
  EXPECT_EQ(find_jpeg_flaw("").kind, JpegFlaw::Kind::kNone);
}

TEST(UnreadImage, AThumbnailBeforeThePictureIsNotItsEnd) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  const std::string whole = encode_jpeg(gradient(), 90).value();
  const std::string thumbnail("\xff\xe1\0\6Ex\xff\xd9", 8);  // a segment that holds the marker of the end
  write_text(path, whole.substr(0, 2) + thumbnail + whole.substr(2));
  EXPECT_TRUE(read_image(path));
  write_text(path, whole.substr(0, 2) + thumbnail + whole.substr(2, whole.size() - 40));
  expect_bad_input(read_image(path), {"ends too early"});
}

TEST(UnreadImage, OtherKindsAreNamedWithTheWayToConvertThem) {
  const TemporaryFolder folder;
  const struct {
    const char* name;
    std::string bytes;
    const char* remedy;
  } files[] = {{"a.gif", "GIF89a" + std::string(40, '\1'), "convert it to PNG"},
               {"a.nef", std::string("MM\0*\0\0\0\10", 8) + std::string(40, '\1'), "develop"},
               {"a.CR3", std::string("\0\0\0\30ftypcrx ", 12) + std::string(40, '\1'), "develop"},
               {"a.psd", "8BPS" + std::string(40, '\1'), "save it as TIFF"},
               {"a.png", "version https://git-lfs.github.com/spec/v1\noid sha256:12\n", "git lfs pull"}};
  for (const auto& file : files) {
    write_text(folder.path() / file.name, file.bytes);
    expect_bad_input(read_image(folder.path() / file.name), {file.name, file.remedy});
    expect_bad_input(read_image_header(folder.path() / file.name), {file.name, file.remedy});
  }
  write_text(folder.path() / "b.dng", encode_png(gradient()).value());
  EXPECT_TRUE(read_image(folder.path() / "b.dng")) << "whatever its name, it is a PNG file";
}

}  // namespace
}  // namespace quorum
