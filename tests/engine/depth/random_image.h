// An image of random colors, for tests of windows.
#pragma once

#include <random>

#include "engine/image/padded_image.h"

namespace quorum {

inline PaddedImage random_image(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  ColorImage image(width, height);
  for (Rgba& pixel : image.values) pixel = static_cast<Rgba>(random() & 0xffffffU);
  return pad_image(image);
}

}  // namespace quorum
