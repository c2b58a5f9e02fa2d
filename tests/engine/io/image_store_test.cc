#include "engine/io/image_store.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr std::size_t kImageBytes = 4 * kWidth * kHeight;

/// Four images of one color each, without masks.
class ImageStoreTest : public testing::Test {
 protected:
  ImageStoreTest() {
    for (int i = 0; i < 4; ++i) {
      View view;
      view.name = std::to_string(i);
      view.image_path = folder_.path() / (view.name + ".png");
      view.width = kWidth;
      view.height = kHeight;
      EXPECT_TRUE(write_png(view.image_path, ColorImage(kWidth, kHeight, color(i))));
      scene_.views.push_back(view);
    }
  }

  static Rgba color(int view) { return make_rgb(50 * view, 0, 0); }
  void remove_images() {
    for (const View& view : scene_.views) std::filesystem::remove(view.image_path);
  }
  void set_mask(int view, int width, int height, const std::string& left, const std::string& right) {
    std::string text = "P2 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) text += (x < width / 2 ? left : right) + "\n";
    scene_.views[view].mask_path = folder_.path() / "mask.pgm";
    write_text(scene_.views[view].mask_path, text);
  }

  TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(ImageStoreTest, GivesTheImageOfTheView) {
  ImageStore store(scene_, 1 << 20);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(**store.image(i), ColorImage(kWidth, kHeight, color(i)));
  EXPECT_EQ(store.kept_bytes(), 4 * kImageBytes);
  EXPECT_EQ(*store.image(2), *store.image(2));
}

TEST_F(ImageStoreTest, APaddedImageIsKeptInPlaceOfTheImage) {
  ImageStore store(scene_, 1 << 20);
  const auto padded = store.padded(1).value();
  EXPECT_EQ(padded->pixels, pad_image(ColorImage(kWidth, kHeight, color(1))).pixels);
  EXPECT_EQ(store.kept_bytes(), padded->pixels.size() * sizeof(Rgba) * 4 / 3);
  EXPECT_EQ(store.padded(1).value(), padded);
  remove_images();
  EXPECT_EQ(store.padded(1).value(), padded);
  EXPECT_FALSE(store.padded(2));
}

TEST_F(ImageStoreTest, APaddedImageIsMadeOfAnImageThatIsThere) {
  ImageStore store(scene_, 1 << 20);
  const auto image = store.image(3).value();
  remove_images();
  EXPECT_EQ(store.padded(3).value()->pixels, pad_image(*image).pixels);
}

TEST_F(ImageStoreTest, DropsWhatWasUsedLeastRecently) {
  ImageStore store(scene_, 2 * kImageBytes);
  const auto first = store.image(0);
  ASSERT_TRUE(first && store.image(1) && store.image(0) && store.image(2));
  EXPECT_EQ(store.kept_bytes(), 2 * kImageBytes);
  remove_images();
  const auto again = store.image(0);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, *first);
  EXPECT_TRUE(store.image(2));
  expect_bad_input(store.image(1), {"1.png: cannot read"});
}

TEST_F(ImageStoreTest, KeepsNothingAboveItsBudget) {
  for (const std::size_t budget : {std::size_t{0}, kImageBytes - 1}) {
    ImageStore store(scene_, budget);
    EXPECT_EQ(**store.image(3), ColorImage(kWidth, kHeight, color(3)));
    EXPECT_EQ(store.kept_bytes(), 0U);
  }
}

TEST_F(ImageStoreTest, FailureIsNotRemembered) {
  ImageStore store(scene_, 1 << 20);
  std::filesystem::rename(scene_.views[0].image_path, folder_.path() / "away");
  EXPECT_FALSE(store.image(0));
  std::filesystem::rename(folder_.path() / "away", scene_.views[0].image_path);
  EXPECT_TRUE(store.image(0));
}

TEST_F(ImageStoreTest, SizeMustBeThatOfTheView) {
  ASSERT_TRUE(write_png(scene_.views[1].image_path, ColorImage(32, 24)));
  ImageStore store(scene_, 1 << 20, 0.1);
  expect_bad_input(store.image(1), {"1.png: is 32 x 24, expected 40 x 30 for its camera"});
  expect_bad_input(store.mask(1), {"1.png: is 32 x 24"});
  ASSERT_TRUE(write_png(scene_.views[2].image_path, ColorImage(kWidth, 24)));
  expect_bad_input(store.image(2), {"2.png: is 40 x 24, expected 40 x 30"});
  set_mask(0, 10, 10, "0", "255");
  expect_bad_input(store.mask(0), {"mask.pgm: is 10 x 10, expected 40 x 30"});
}

TEST_F(ImageStoreTest, MaskIsEmptyWhereNothingMasks) {
  ImageStore store(scene_, 1 << 20);
  remove_images();
  ASSERT_TRUE(store.mask(0));
  EXPECT_TRUE((*store.mask(0))->empty());
  EXPECT_EQ(store.kept_bytes(), 0U);
}

TEST_F(ImageStoreTest, MaskFileAndBackgroundMustBothAgree) {
  // Left half bright, so that the background mask takes 20 columns and a margin of 3; the file takes the right half.
  ColorImage image(kWidth, kHeight, make_rgb(0, 0, 0));
  for (int y = 0; y < kHeight; ++y) std::fill_n(image.row(y), kWidth / 2, make_rgb(0, 200, 0));
  ASSERT_TRUE(write_png(scene_.views[0].image_path, image));
  set_mask(0, kWidth, kHeight, "0", "1");

  ImageStore file_only(scene_, 1 << 20);
  EXPECT_EQ((*file_only.mask(0))->at(19, 10), 0);
  EXPECT_EQ((*file_only.mask(0))->at(30, 10), 1);

  ImageStore both(scene_, 1 << 20, 0.19);
  const Mask mask = **both.mask(0);
  EXPECT_EQ(mask.at(19, 10), 0);
  EXPECT_EQ(mask.at(20, 10), 1);
  EXPECT_EQ(mask.at(22, 10), 1);
  EXPECT_EQ(mask.at(23, 10), 0);

  scene_.views[0].mask_path.clear();
  ImageStore background_only(scene_, 1 << 20, 0.19);
  EXPECT_EQ((*background_only.mask(0))->at(19, 10), 1);
  EXPECT_EQ((*background_only.mask(0))->at(23, 10), 0);
}

TEST_F(ImageStoreTest, AHugeMaskIsRefusedBeforeItIsDecoded) {
  set_mask(0, 8 * kWidth, 8 * kHeight, "0", "1");
  EXPECT_TRUE(ImageStore(scene_, 1 << 20).mask(0)) << "of images_8";
  set_mask(0, 20 * kWidth, 20 * kHeight, "0", "1");
  expect_bad_input(ImageStore(scene_, 1 << 20).mask(0), {"expected", "for its camera"});
}

TEST_F(ImageStoreTest, MaskIsKeptLikeAnImage) {
  set_mask(0, kWidth, kHeight, "0", "1");
  ImageStore store(scene_, 1 << 20);
  const auto mask = store.mask(0);
  std::filesystem::remove(scene_.views[0].mask_path);
  EXPECT_EQ(*store.mask(0), *mask);
  EXPECT_EQ(store.kept_bytes(), kImageBytes / 4);
}

TEST_F(ImageStoreTest, ServesManyTasksAtOnce) {
  ImageStore store(scene_, 2 * kImageBytes + 500, 0.1);
  tbb::parallel_for(0, 6000, [&store](int i) {
    const int view = i * 7 % 4;
    const auto image = store.image(view);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ((*image)->at(kWidth - 1, kHeight - 1), color(view));
    const auto mask = store.mask(view);
    ASSERT_TRUE(mask) << mask.error().message;
    EXPECT_EQ((*mask)->at(0, 0), view > 0 ? 1 : 0);
  });
  EXPECT_LE(store.kept_bytes(), 2 * kImageBytes + 500);
}

}  // namespace
}  // namespace quorum
