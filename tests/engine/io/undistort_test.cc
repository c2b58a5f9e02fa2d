#include "engine/io/undistort.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/io/image_store.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

Lens make_lens() {
  Lens lens;
  lens.width = 200;
  lens.height = 120;
  lens.focal = {150, 150};
  lens.principal = {101, 58};
  lens.coefficients = {-0.2, 0.03, 0.001, 0.002};
  return lens;
}

/// A photograph whose red tells x and whose green tells y.
ColorImage ramp(const Lens& lens) {
  ColorImage image(lens.width, lens.height);
  for (int y = 0; y < lens.height; ++y)
    for (int x = 0; x < lens.width; ++x) image.at(x, y) = make_rgb(x, 2 * y, 7);
  return image;
}

TEST(Undistort, EveryPixelComesFromWhereTheLensShowsItsRay) {
  const Lens lens = make_lens();
  const PinholePicture picture = pinhole_picture(lens).value();
  const ColorImage image = undistort_image(ramp(lens), lens, picture).value();
  ASSERT_EQ(image.width, picture.width);
  ASSERT_EQ(image.height, picture.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Matrix3d& k = picture.intrinsics;
      const Eigen::Vector2d from = lens.project({(x - k(0, 2)) / k(0, 0), (y - k(1, 2)) / k(1, 1)});
      ASSERT_NEAR(red_of(image.at(x, y)), from.x(), 0.8) << x << " " << y;
      ASSERT_NEAR(green_of(image.at(x, y)), 2 * from.y(), 1.1) << x << " " << y;
      ASSERT_EQ(image.at(x, y) >> 24, 255U);
    }
  }
}

TEST(Undistort, LensWithoutDistortionLeavesThePhotographAlone) {
  Lens lens = make_lens();
  lens.coefficients = {};
  EXPECT_EQ(undistort_image(ramp(lens), lens, pinhole_picture(lens).value()).value(), ramp(lens));
}

TEST(Undistort, MasksStayZeroOrOneAndFollow) {
  const Lens lens = make_lens();
  const PinholePicture picture = pinhole_picture(lens).value();
  Mask mask(lens.width, lens.height);
  for (int y = 0; y < lens.height; ++y)
    for (int x = 0; x < 50; ++x) mask.at(x, y) = 1;
  const Mask result = undistort_mask(mask, lens, picture).value();
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const Eigen::Matrix3d& k = picture.intrinsics;
      const double from = lens.project({(x - k(0, 2)) / k(0, 0), (y - k(1, 2)) / k(1, 1)}).x();
      if (std::abs(from - 49.5) < 0.1) continue;
      ASSERT_EQ(result.at(x, y), from < 49.5 ? 1 : 0) << x << " " << y;
    }
  }
}

TEST(Undistort, StoreHandsOutWhatTheViewSays) {
  const TemporaryFolder folder;
  const Lens lens = make_lens();
  const PinholePicture picture = pinhole_picture(lens).value();
  View view;
  view.image_path = folder.path() / "a.png";
  view.mask_path = folder.path() / "mask.png";
  view.width = picture.width;
  view.height = picture.height;
  view.camera.intrinsics = picture.intrinsics;
  view.lens = lens;
  view.photo_width = lens.width;
  view.photo_height = lens.height;
  ASSERT_TRUE(write_png(view.image_path, ramp(lens)));
  ASSERT_TRUE(write_png(view.mask_path, ColorImage(lens.width, lens.height, make_rgb(9, 9, 9))));
  const Scene scene{{view}, {}};
  ImageStore store(scene, 1 << 20);
  EXPECT_EQ(**store.image(0), undistort_image(ramp(lens), lens, picture).value());
  EXPECT_EQ(**store.mask(0), Mask(picture.width, picture.height, 1));
  ASSERT_TRUE(write_png(view.mask_path, ColorImage(picture.width, picture.height)));
  ImageStore again(scene, 1 << 20);
  expect_bad_input(again.mask(0), {"mask.png: is", "expected 200 x 120"});
}

}  // namespace
}  // namespace quorum
