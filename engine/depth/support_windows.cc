#include "engine/depth/support_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/core/exact.h"

namespace quorum {
namespace {

constexpr int kMaxWindow = 15;

/// The pixels of one window, row by row.
struct Pixels {
  std::array<Rgba, kMaxWindow * kMaxWindow> color;
  std::array<std::int32_t, kMaxWindow * kMaxWindow> difference;  ///< from the center, largest of the channels
  std::size_t count = 0;
};

std::int32_t largest_difference(Rgba a, Rgba b) {
  const auto difference = [](std::uint32_t left, std::uint32_t right) {
    return static_cast<std::int32_t>(left > right ? left - right : right - left);
  };
  return std::max(
      {difference(red_of(a), red_of(b)), difference(green_of(a), green_of(b)), difference(blue_of(a), blue_of(b))});
}

Pixels read_window(const PaddedImage& image, int x, int y, int radius) {
  Pixels pixels;
  const Rgba center = image.at(x, y);
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Rgba color = image.at(x + dx, y + dy);
      pixels.color[pixels.count] = color;
      pixels.difference[pixels.count++] = largest_difference(color, center);
    }
  }
  return pixels;
}

/// The difference that at least a share of 9 / 25 of the pixels does not exceed.
std::int32_t least_difference(const Pixels& pixels) {
  std::array<std::int32_t, kMaxWindow* kMaxWindow> sorted = pixels.difference;
  const auto last = static_cast<std::ptrdiff_t>((pixels.count * 9 + 24) / 25) - 1;
  std::nth_element(sorted.begin(), sorted.begin() + last, sorted.begin() + static_cast<std::ptrdiff_t>(pixels.count));
  return sorted[static_cast<std::size_t>(last)];
}

SupportWindow sum_support(const Pixels& pixels, std::int32_t max_difference, int shift) {
  SupportWindow support{};
  support.max_difference = max_difference;
  std::int32_t squares = 0;
  for (std::size_t i = 0; i < pixels.count; ++i) {
    if (pixels.difference[i] > max_difference) continue;
    const std::uint32_t channels[3] = {red_of(pixels.color[i]), green_of(pixels.color[i]), blue_of(pixels.color[i])};
    for (int channel = 0; channel < 3; ++channel) {
      const std::int32_t sample = static_cast<std::int32_t>((channels[channel] << 16) >> shift) - (1 << (23 - shift));
      support.sum[channel] += sample;
      squares += sample * sample;
    }
    ++support.samples;
  }
  double variance = static_cast<double>(support.samples) * squares;
  for (const std::int32_t sum : support.sum) variance -= static_cast<double>(sum) * sum;
  support.inverse_deviation = reciprocal_sqrt(float_from_integer(variance));
  return support;
}

}  // namespace

Grid<SupportWindow> make_support_windows(const PaddedImage& image, int window, int tolerance) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  Grid<SupportWindow> windows(image.width, image.height);
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    for (int x = radius; x < image.width - radius; ++x) {
      const Pixels pixels = read_window(image, x, y, radius);
      windows.at(x, y) = sum_support(pixels, std::max(tolerance, least_difference(pixels)), shift);
    }
  });
  return windows;
}

}  // namespace quorum
