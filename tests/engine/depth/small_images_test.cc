#include "engine/depth/small_images.h"

#include <gtest/gtest.h>

#include <memory>

#include "engine/image/halve.h"

namespace quorum {
namespace {

std::shared_ptr<const PaddedImage> image_of(int side, Rgba first) {
  ColorImage colors(side, side);
  for (std::size_t i = 0; i < colors.values.size(); ++i) colors.values[i] = first + static_cast<Rgba>(7 * i % 250);
  return std::make_shared<const PaddedImage>(pad_image(colors));
}

TEST(SmallImages, AreThoseOfHalveImage) {
  SmallImages images;
  ColorImage colors(9, 8);
  for (std::size_t i = 0; i < colors.values.size(); ++i) colors.values[i] = static_cast<Rgba>(i * 2654435761U);
  const auto image = std::make_shared<const PaddedImage>(pad_image(colors));
  EXPECT_EQ(images.of(image, 0), image);
  EXPECT_EQ(images.of(image, 1)->pixels, pad_image(halve_image(colors)).pixels);
  EXPECT_EQ(images.of(image, 2)->pixels, pad_image(halve_image(halve_image(colors))).pixels);
}

TEST(SmallImages, AreMadeOnceAndGoWithTheirImage) {
  SmallImages images;
  auto image = image_of(16, 1);
  const auto small = images.of(image, 2);
  EXPECT_EQ(images.of(image, 2), small);
  const std::weak_ptr<const PaddedImage> half = images.of(image, 1);
  image.reset();
  const auto other = image_of(16, 3);
  EXPECT_NE(images.of(other, 2)->pixels, small->pixels);
  EXPECT_TRUE(half.expired());
}

}  // namespace
}  // namespace quorum
