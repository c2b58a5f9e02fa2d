#include "engine/depth/support_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/depth/reference_windows.h"

namespace quorum {
namespace {

constexpr int kMaxWindow = 15;

SupportWindow support_of(const ReferenceSums& sums, std::int32_t samples, std::int32_t max_difference) {
  const ReferenceWindow window = window_from_sums(sums, samples);
  return {{window.sum[0], window.sum[1], window.sum[2]}, window.inverse_deviation, samples, max_difference};
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
  ReferenceSums sums;
  std::int32_t samples = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (difference[i] > *last) continue;
    const Rgba color = image.at(x + static_cast<int>(i) % window - radius, y + static_cast<int>(i) / window - radius);
    add_sample(sums, sample_pixel(color, shift));
    ++samples;
  }
  return support_of(sums, samples, *last);
}

/// Sums of the windows around the pixels of a row, each as an array, for the compiler to vectorize.
struct RowSums {
  std::vector<std::int32_t> sum[3];
  std::vector<std::int32_t> squares;
  std::vector<std::int32_t> samples;
};

/// Sums over the pixels that differ from their window's center by at most the tolerance.
[[gnu::always_inline]] inline void sum_row(const PaddedImage& image, int y, int window, int tolerance, int shift,
                                           RowSums& row) {
  const int radius = window / 2;
  const auto count = static_cast<std::size_t>(image.width - 2 * radius);  // first pixel: radius
  for (auto* values : {&row.sum[0], &row.sum[1], &row.sum[2], &row.squares, &row.samples}) values->assign(count, 0);
  const Rgba* center = image.pixels.data() + std::ptrdiff_t{y} * image.stride() + radius;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Rgba* pixel = center + std::ptrdiff_t{dy} * image.stride() + dx;
      for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t belongs = (largest_difference(pixel[i], center[i]) - tolerance - 1) >> 31;
        const Sample sample = sample_pixel(pixel[i], shift);
        const Sample kept{sample.red & belongs, sample.green & belongs, sample.blue & belongs};
        row.sum[0][i] += kept.red;
        row.sum[1][i] += kept.green;
        row.sum[2][i] += kept.blue;
        row.squares[i] += product(kept, kept);
        row.samples[i] -= belongs;
      }
    }
  }
}

}  // namespace

Grid<SupportWindow> make_support_windows(const PaddedImage& image, int window, int tolerance, SimdLevel simd) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  Grid<SupportWindow> windows(image.width, image.height);
  if (image.width < window) return windows;
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    thread_local RowSums row;
    simd_form<sum_row>(simd)(image, y, window, tolerance, shift, row);
    for (std::size_t i = 0; i < row.samples.size(); ++i) {
      const int x = radius + static_cast<int>(i);
      windows.at(x, y) =
          row.samples[i] >= least_samples(window)
              ? support_of({{row.sum[0][i], row.sum[1][i], row.sum[2][i]}, row.squares[i]}, row.samples[i], tolerance)
              : least_support(image, x, y, window, shift);
    }
  });
  return windows;
}

}  // namespace quorum
