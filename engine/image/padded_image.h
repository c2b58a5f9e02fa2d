// An image as the sweep reads it: one more column and row than the photograph, so that interpolation at the last pixel
// may read its right and lower neighbors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"

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

/// One interpolated sample, centered: 12 bits a channel (11 for windows above kLargestFullPrecisionWindow).
struct Sample {
  std::int32_t red = 0;
  std::int32_t green = 0;
  std::int32_t blue = 0;
};

/// Bits that a sample drops beyond kSampleShift so that the sums of a window fit 32 bits. window: 3 to 15 pixels.
int extra_sample_shift(int window);

/// Bilinear interpolation in integers at (u, v), in 1/256 pixel, 0 <= u <= 256 (width - 1), v likewise.
/// Twin: sample_bilinear in shaders/lib/sample_bilinear.glsl.
Sample sample_bilinear(const PaddedImage& image, int u, int v, int extra_shift);

/// The same from four texels, in a form for loops that the compiler vectorizes: upper left, upper right, lower left,
/// lower right; fractions in 1/256 pixel; shift: kSampleShift and what is dropped beyond. Red and blue share a word
/// along x: the exact results fit 16 bits each, so arithmetic modulo 2^32 on both at once gives both.
[[gnu::always_inline]] inline Sample interpolate_texels(Rgba p00, Rgba p10, Rgba p01, Rgba p11,
                                                        std::uint32_t fraction_x, std::uint32_t fraction_y, int shift) {
  constexpr std::uint32_t kRedBlue = 0x00ff00ffU;
  const std::int32_t center = 1 << (23 - shift);
  const auto along_x = [fraction_x](std::uint32_t left, std::uint32_t right) {
    return (left << 8) + (right - left) * fraction_x;
  };
  const auto along_y = [&](std::uint32_t top, std::uint32_t bottom) {
    return static_cast<std::int32_t>(((top << 8) + (bottom - top) * fraction_y) >> shift) - center;
  };
  const std::uint32_t top = along_x(p00 & kRedBlue, p10 & kRedBlue);
  const std::uint32_t bottom = along_x(p01 & kRedBlue, p11 & kRedBlue);
  return {along_y(top & 0xffffU, bottom & 0xffffU),
          along_y(along_x(green_of(p00), green_of(p10)), along_x(green_of(p01), green_of(p11))),
          along_y(top >> 16, bottom >> 16)};
}

}  // namespace quorum
