// Images as the stages read them: 8 bits a channel, one 32-bit word a pixel.
#pragma once

#include <cstdint>

#include "engine/core/grid.h"

namespace quorum {

/// One pixel: red in bits 0-7, green 8-15, blue 16-23; the top byte is 255 in an image and free for masks.
using Rgba = std::uint32_t;

constexpr Rgba make_rgb(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return red | green << 8 | blue << 16 | 0xff000000U;
}
constexpr std::uint32_t red_of(Rgba pixel) { return pixel & 0xffU; }
constexpr std::uint32_t green_of(Rgba pixel) { return pixel >> 8 & 0xffU; }
constexpr std::uint32_t blue_of(Rgba pixel) { return pixel >> 16 & 0xffU; }

/// A color photograph.
using ColorImage = Grid<Rgba>;

/// 1 where a pixel takes part, 0 where it is masked out. Empty means that every pixel takes part.
using Mask = Grid<std::uint8_t>;

}  // namespace quorum
