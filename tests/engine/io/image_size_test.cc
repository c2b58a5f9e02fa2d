#include "engine/io/image_size.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/io/image_file.h"
#include "engine/io/write_image.h"
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

TEST_F(ImageSizeTest, HugePicturesOfManyKindsAreNotDecoded) {
  constexpr ImageSize kHuge{20000, 30000};
  const auto number = [](std::uint32_t value, int bytes, bool little) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * (little ? i : bytes - 1 - i));
    return text;
  };
  // One by one: a chain of + over temporaries lets GCC 12 warn of bounds that are kept.
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
  };
  EXPECT_EQ(read("P6\n# a comment\n20000 30000 65535\n").value(), kHuge);
  EXPECT_EQ(read_image_header(path_)->bits, 16);
  EXPECT_EQ(read(joined({"BM", std::string(16, '\0'), number(20000, 4, true),
                         number(static_cast<std::uint32_t>(-30000), 4, true), std::string(30, '\0')}))
                .value(),
            kHuge);
  for (const bool little : {true, false}) {
    const auto entry = [&](std::uint32_t tag, std::uint32_t value) {
      return joined({number(tag, 2, little), number(4, 2, little), number(1, 4, little), number(value, 4, little)});
    };
    const std::string tiff = joined({little ? "II" : "MM", number(42, 2, little), number(8, 4, little),
                                     number(3, 2, little), entry(256, 20000), entry(257, 30000), entry(258, 16)});
    EXPECT_EQ(read(tiff).value(), kHuge) << little;
    EXPECT_EQ(read_image_header(path_)->bits, 16);
  }
  const std::string webp = joined({"RIFF    WEBPVP8X", number(10, 4, true), std::string("\x10\0\0\0", 4),
                                   number(16000 - 1, 3, true), number(12000 - 1, 3, true)});
  EXPECT_EQ(read(webp).value(), (ImageSize{16000, 12000}));
  EXPECT_TRUE(read_image_header(path_)->has_alpha);
  EXPECT_EQ(decoded_bytes({{1000, 1000}, 8, false}), 8'000'000U);
  EXPECT_EQ(decoded_bytes({{1000, 1000}, 16, false}), 12'000'000U);
}

TEST(CommonFactor, IsThatOfOnePictureAtTwoSizes) {
  EXPECT_EQ(common_factor({640, 480}, {640, 480}), 1.0);
  EXPECT_EQ(common_factor({640, 480}, {320, 240}), 0.5);
  EXPECT_NEAR(common_factor({1297, 840}, {649, 420}).value(), 0.5, 1e-3);
  EXPECT_NEAR(common_factor({648, 420}, {1297, 840}).value(), 2.0, 1e-2);
  EXPECT_NEAR(common_factor({6000, 4000}, {1600, 1067}).value(), 1600 / 6000.0, 1e-3);
  EXPECT_FALSE(common_factor({640, 480}, {480, 640})) << "turned";
  EXPECT_FALSE(common_factor({640, 480}, {640, 400})) << "cropped";
  EXPECT_FALSE(common_factor({640, 480}, {636, 477})) << "cropped by little";
  EXPECT_FALSE(common_factor({0, 480}, {640, 480}));
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
