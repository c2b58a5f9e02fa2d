#include "engine/io/image_size.h"

#include <gtest/gtest.h>

#include "engine/io/image_file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// A JPEG as far as its frame: an application's segment, a table, fill bytes, then the size 300 x 517.
std::string jpeg_header() {
  return {"\xff\xd8\xff\xe1\x00\x05zzz\xff\xc4\x00\x04zz\xff\xff\xff\xc2\x00\x0b\x08\x02\x05\x01\x2c\x03", 27};
}

class ImageSizeTest : public testing::Test {
 protected:
  Expected<ImageSize> read(const std::string& bytes) {
    write_text(path_, bytes);
    return read_image_size(path_);
  }
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "image";
};

TEST_F(ImageSizeTest, HeadersTellIt) {
  EXPECT_EQ(read(jpeg_header()).value(), (ImageSize{300, 517}));
  ASSERT_TRUE(write_png(path_, ColorImage(3, 1027)));
  EXPECT_EQ(read_image_size(path_).value(), (ImageSize{3, 1027}));
}

TEST_F(ImageSizeTest, OtherKindsAreDecoded) {
  EXPECT_EQ(read("P2 3 2 255\n1 2 3\n4 5 6\n").value(), (ImageSize{3, 2}));
}

TEST_F(ImageSizeTest, WhatTellsNoneIsRefused) {
  for (std::size_t size = 0; size + 4 < jpeg_header().size(); ++size)
    expect_bad_input(read(jpeg_header().substr(0, size)), {"image: "});
  expect_bad_input(read("no image"), {"image: "});
  expect_bad_input(read_image_size(folder_.path()), {"is a folder"});
  expect_bad_input(read_image_size(folder_.path() / "none"), {"none"});
}

TEST_F(ImageSizeTest, IsThatOfTheDecodedPhotograph) {
  if (data_folder().empty()) GTEST_SKIP() << "no ../shared/data";
  for (const char* name : {"colmap_bartoszek/images/DSC_5290.jpg", "colmap_lund_door/images/DSC_0001.JPG"}) {
    const auto image = read_image(data_folder() / name);
    ASSERT_TRUE(image);
    EXPECT_EQ(read_image_size(data_folder() / name).value(), (ImageSize{image->width, image->height}));
  }
}

}  // namespace
}  // namespace quorum
