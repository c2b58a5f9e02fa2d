// An image as the sweep reads it: one more column and row than the photograph, so that interpolation at the last pixel
// may read its right and lower neighbors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/sample_bilinear.h"

namespace quorum {

/// width × height pixels, stored with stride = width + 1 and height + 1 rows; the last column and row repeat.
struct PaddedImage {
  int width = 0;
  int height = 0;
  std::vector<Rgba> pixels;

  [[nodiscard]] int stride() const { return width + 1; }
  [[nodiscard]] Rgba at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(x)];
  }
};

PaddedImage pad_image(const ColorImage& image);

/// Bilinear interpolation in integers at (u, v), in 1/256 pixel, 0 <= u <= 256 (width - 1), v likewise.
/// extra_shift: as extra_sample_shift gives it.
Sample sample_bilinear(const PaddedImage& image, int u, int v, int extra_shift);

}  // namespace quorum
