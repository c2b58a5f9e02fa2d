// Bilinear interpolation in integers, for loops that the compiler vectorizes. Twin: shaders/lib/sample_bilinear.glsl.
#pragma once

#include <cstdint>

#include "engine/image/image.h"
#include "shaders/layout.h"

namespace quorum {

/// One interpolated sample, centered: 24 - shift bits a channel, where shift is kSampleShift and what is dropped
/// beyond.
struct Sample {
  std::int32_t red = 0;
  std::int32_t green = 0;
  std::int32_t blue = 0;
};

/// Bits that a sample drops beyond kSampleShift so that the sums of a window fit 32 bits. window: 3 to 15 pixels.
constexpr int extra_sample_shift(int window) { return window > kLargestFullPrecisionWindow ? 1 : 0; }

/// Two texels interpolated along x, 16 bits a channel. Red and blue share a word: the exact results fit 16 bits each,
/// so arithmetic modulo 2^32 on both at once gives both.
struct AlongX {
  std::uint32_t red_blue = 0;
  std::uint32_t green = 0;
};

/// u: 1/256 pixel, of which the fraction counts.
[[gnu::always_inline]] inline AlongX interpolate_along_x(Rgba left, Rgba right, int u) {
  constexpr std::uint32_t kRedBlue = 0x00ff00ffU;
  const auto fraction = static_cast<std::uint32_t>(u & (kPositionScale - 1));
  const auto interpolate = [fraction](std::uint32_t from, std::uint32_t to) {
    return (from << 8) + (to - from) * fraction;
  };
  return {interpolate(left & kRedBlue, right & kRedBlue), interpolate(green_of(left), green_of(right))};
}

[[gnu::always_inline]] inline Sample interpolate_along_y(const AlongX& top, const AlongX& bottom, int v, int shift) {
  const auto fraction = static_cast<std::uint32_t>(v & (kPositionScale - 1));
  const std::int32_t center = 1 << (23 - shift);
  const auto interpolate = [&](std::uint32_t from, std::uint32_t to) {
    return static_cast<std::int32_t>(((from << 8) + (to - from) * fraction) >> shift) - center;
  };
  return {interpolate(top.red_blue & 0xffffU, bottom.red_blue & 0xffffU), interpolate(top.green, bottom.green),
          interpolate(top.red_blue >> 16, bottom.red_blue >> 16)};
}

/// The sample at (u, v), in 1/256 pixel, from its four texels: upper left, upper right, lower left, lower right.
[[gnu::always_inline]] inline Sample sample_bilinear(Rgba p00, Rgba p10, Rgba p01, Rgba p11, int u, int v, int shift) {
  return interpolate_along_y(interpolate_along_x(p00, p10, u), interpolate_along_x(p01, p11, u), v, shift);
}

/// The sample at a pixel's center.
[[gnu::always_inline]] inline Sample sample_pixel(Rgba pixel, int shift) {
  const auto sample = [shift](std::uint32_t channel) {
    return static_cast<std::int32_t>((channel << 16) >> shift) - (1 << (23 - shift));
  };
  return {sample(red_of(pixel)), sample(green_of(pixel)), sample(blue_of(pixel))};
}

/// Index of the upper left of the four texels of a position in 1/256 pixel.
[[gnu::always_inline]] inline int texel_index(int u, int v, int stride) {
  return (v >> kPositionBits) * stride + (u >> kPositionBits);
}

/// By how much two pixels differ in the channel in which they differ most, 0..255.
[[gnu::always_inline]] inline std::int32_t largest_difference(Rgba a, Rgba b) {
  const auto apart = [](std::uint32_t from, std::uint32_t to) {
    const auto difference = static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
    return difference < 0 ? -difference : difference;
  };
  const auto larger = [](std::int32_t x, std::int32_t y) { return x > y ? x : y; };
  return larger(larger(apart(red_of(a), red_of(b)), apart(green_of(a), green_of(b))), apart(blue_of(a), blue_of(b)));
}

}  // namespace quorum
