// The color of a photograph between its pixels.
#pragma once

#include <algorithm>
#include <array>

#include "engine/image/sample_bilinear.h"

namespace quorum {

/// Red, green and blue at a place in 1/256 pixel, in 1/256 levels, by integers; outside of the image as at its border.
inline std::array<std::int32_t, 3> sample_color(const ColorImage& image, std::int32_t u, std::int32_t v) {
  u = std::clamp(u, 0, (image.width - 1) << kPositionBits);
  v = std::clamp(v, 0, (image.height - 1) << kPositionBits);
  const int x = u >> kPositionBits;
  const int y = v >> kPositionBits;
  const int right = std::min(x + 1, image.width - 1);
  const int below = std::min(y + 1, image.height - 1);
  constexpr int kShift = 8;  // leaves 16 bits
  constexpr std::int32_t kCenter = 1 << 15;
  const Sample sample =
      sample_bilinear(image.at(x, y), image.at(right, y), image.at(x, below), image.at(right, below), u, v, kShift);
  return {sample.red + kCenter, sample.green + kCenter, sample.blue + kCenter};
}

/// The levels of a pixel.
inline std::array<std::int32_t, 3> levels_of(Rgba pixel) {
  return {static_cast<std::int32_t>(red_of(pixel)), static_cast<std::int32_t>(green_of(pixel)),
          static_cast<std::int32_t>(blue_of(pixel))};
}

}  // namespace quorum
