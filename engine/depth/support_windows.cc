#include "engine/depth/support_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "engine/core/exact.h"

namespace quorum {
namespace {

constexpr int kMaxWindow = 15;

std::int32_t apart(std::uint32_t a, std::uint32_t b) {
  return std::abs(static_cast<std::int32_t>(a) - static_cast<std::int32_t>(b));
}

std::int32_t largest_difference(Rgba a, Rgba b) {
  return std::max(std::max(apart(red_of(a), red_of(b)), apart(green_of(a), green_of(b))),
                  apart(blue_of(a), blue_of(b)));
}

std::int32_t sample_of(std::uint32_t channel, int shift) {
  return static_cast<std::int32_t>((channel << 16) >> shift) - (1 << (23 - shift));
}

/// Sums over the pixels of a window that belong to its support.
struct Sums {
  std::int32_t sum[3] = {0, 0, 0};
  std::int32_t squares = 0;
  std::int32_t samples = 0;
};

SupportWindow support_of(const Sums& sums, std::int32_t max_difference) {
  SupportWindow support{};
  double variance = static_cast<double>(sums.samples) * sums.squares;
  for (int channel = 0; channel < 3; ++channel) {
    support.sum[channel] = sums.sum[channel];
    variance -= static_cast<double>(sums.sum[channel]) * sums.sum[channel];
  }
  support.inverse_deviation = reciprocal_sqrt(float_from_integer(variance));
  support.samples = sums.samples;
  support.max_difference = max_difference;
  return support;
}

/// The fewest samples of a support: 9 of 25.
std::int32_t least_samples(int window) { return (window * window * 9 + 24) / 25; }

/// The support of the window around (x, y) that has the fewest samples; all that differ as much as the last one of them
/// belong to it.
SupportWindow least_support(const PaddedImage& image, int x, int y, int window, int shift) {
  const int radius = window / 2;
  std::array<std::int32_t, kMaxWindow* kMaxWindow> difference = {};
  const Rgba center = image.at(x, y);
  std::size_t count = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx)
      difference[count++] = largest_difference(image.at(x + dx, y + dy), center);
  std::array<std::int32_t, kMaxWindow* kMaxWindow> sorted = difference;
  const auto last = sorted.begin() + least_samples(window) - 1;
  std::nth_element(sorted.begin(), last, sorted.begin() + static_cast<std::ptrdiff_t>(count));
  Sums sums;
  for (std::size_t i = 0; i < count; ++i) {
    if (difference[i] > *last) continue;
    const Rgba color = image.at(x + static_cast<int>(i) % window - radius, y + static_cast<int>(i) / window - radius);
    const std::uint32_t channels[3] = {red_of(color), green_of(color), blue_of(color)};
    for (int channel = 0; channel < 3; ++channel) {
      const std::int32_t sample = sample_of(channels[channel], shift);
      sums.sum[channel] += sample;
      sums.squares += sample * sample;
    }
    ++sums.samples;
  }
  return support_of(sums, *last);
}

/// Sums of the windows around the pixels of a row, each as an array, for the compiler to vectorize.
struct RowSums {
  std::vector<std::int32_t> sum[3];
  std::vector<std::int32_t> squares;
  std::vector<std::int32_t> samples;
};

/// Sums over the pixels that differ from their window's center by at most the tolerance.
void sum_row(const PaddedImage& image, int y, int window, int tolerance, int shift, RowSums& row) {
  const int radius = window / 2;
  const auto count = static_cast<std::size_t>(image.width - 2 * radius);  // first pixel: radius
  for (auto* values : {&row.sum[0], &row.sum[1], &row.sum[2], &row.squares, &row.samples}) values->assign(count, 0);
  const Rgba* center = image.pixels.data() + std::ptrdiff_t{y} * image.stride() + radius;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Rgba* pixel = center + std::ptrdiff_t{dy} * image.stride() + dx;
      for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t belongs = (largest_difference(pixel[i], center[i]) - tolerance - 1) >> 31;
        const std::int32_t red = sample_of(red_of(pixel[i]), shift) & belongs;
        const std::int32_t green = sample_of(green_of(pixel[i]), shift) & belongs;
        const std::int32_t blue = sample_of(blue_of(pixel[i]), shift) & belongs;
        row.sum[0][i] += red;
        row.sum[1][i] += green;
        row.sum[2][i] += blue;
        row.squares[i] += red * red + green * green + blue * blue;
        row.samples[i] -= belongs;
      }
    }
  }
}

}  // namespace

Grid<SupportWindow> make_support_windows(const PaddedImage& image, int window, int tolerance) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  Grid<SupportWindow> windows(image.width, image.height);
  if (image.width < window) return windows;
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    thread_local RowSums row;
    sum_row(image, y, window, tolerance, shift, row);
    for (std::size_t i = 0; i < row.samples.size(); ++i) {
      const int x = radius + static_cast<int>(i);
      windows.at(x, y) =
          row.samples[i] >= least_samples(window)
              ? support_of({{row.sum[0][i], row.sum[1][i], row.sum[2][i]}, row.squares[i], row.samples[i]}, tolerance)
              : least_support(image, x, y, window, shift);
    }
  });
  return windows;
}

}  // namespace quorum
