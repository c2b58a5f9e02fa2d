#include "engine/depth/support_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/depth/reference_windows.h"

namespace quorum {
namespace {

constexpr int kMaxWindow = 15;

[[gnu::always_inline]] inline SupportWindow support_of(const ReferenceSums& sums, std::int32_t samples,
                                                       std::int32_t max_difference) {
  const ReferenceWindow window = window_from_sums(sums, samples);
  return {{window.sum[0], window.sum[1], window.sum[2]}, window.inverse_deviation, samples, max_difference};
}

/// The fewest samples of a support: 9 of 25.
std::int32_t least_samples(int window) { return (window * window * 9 + 24) / 25; }

/// The support of the window around (x, y) of pixels that differ from it by at most this much.
SupportWindow support_within(const PaddedImage& image, int x, int y, int window, int shift,
                             std::int32_t max_difference) {
  const int radius = window / 2;
  const Rgba center = image.at(x, y);
  ReferenceSums sums;
  std::int32_t samples = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Rgba pixel = image.at(x + dx, y + dy);
      if (largest_difference(pixel, center) > max_difference) continue;
      add_sample(sums, sample_pixel(pixel, shift));
      ++samples;
    }
  }
  return support_of(sums, samples, max_difference);
}

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
  const auto last = difference.begin() + least_samples(window) - 1;
  std::nth_element(difference.begin(), last, difference.begin() + static_cast<std::ptrdiff_t>(count));
  return support_within(image, x, y, window, shift, *last);
}

constexpr std::size_t kPixels = 16;  // side by side, in a vector
using Words [[gnu::vector_size(4 * kPixels)]] = std::uint32_t;
using Shorts [[gnu::vector_size(4 * kPixels)]] = std::uint16_t;
using Bytes [[gnu::vector_size(4 * kPixels)]] = std::uint8_t;

/// Sums over the supports of pixels side by side.
struct SupportSums {
  Words red_blue;  ///< of the bytes, in a word's two halves: 225 times 255 fit
  Words green;
  Words squares;  ///< of all channels
  Words samples;
};

/// Over the pixels that differ from their window's center by at most the tolerance. at: the first center, in rows of
/// `stride`.
[[gnu::always_inline]] inline void sum_supports(const Rgba* at, int stride, int window, int tolerance,
                                                SupportSums& sums) {
  constexpr std::uint32_t kRedBlue = 0x00ff00ffU;
  constexpr std::uint32_t kColors = 0x00ffffffU;
  const int radius = window / 2;
  Bytes center;
  std::memcpy(&center, at, sizeof(center));
  const Bytes most = Bytes{} + static_cast<std::uint8_t>(tolerance);
  sums = SupportSums();
  for (int dy = -radius; dy <= radius; ++dy) {
    const Rgba* row = at + std::ptrdiff_t{dy} * stride;
    for (int dx = -radius; dx <= radius; ++dx) {
      Bytes pixel;
      std::memcpy(&pixel, row + dx, sizeof(pixel));
      const auto above = reinterpret_cast<Bytes>(pixel > center);
      const Bytes difference = ((pixel - center) & above) | ((center - pixel) & ~above);
      const auto differs = reinterpret_cast<Words>(difference > most) & kColors;
      const auto belongs = reinterpret_cast<Words>(differs == 0);
      const Words kept = reinterpret_cast<Words>(pixel) & belongs;
      const Words red_blue = kept & kRedBlue;
      const Words green = kept >> 8 & 0xffU;
      const auto shorts = reinterpret_cast<Shorts>(red_blue);
      const auto products = reinterpret_cast<Words>(shorts * shorts);
      const auto green_shorts = reinterpret_cast<Shorts>(green);
      sums.red_blue += red_blue;
      sums.green += green;
      sums.squares += (products & 0xffffU) + (products >> 16) + reinterpret_cast<Words>(green_shorts * green_shorts);
      sums.samples -= belongs;
    }
  }
}

/// The supports of kPixels pixels, as far as they are large enough; the others keep 0 samples.
[[gnu::always_inline]] inline void find_supports(const Rgba* at, int stride, int window, int tolerance, int shift,
                                                 std::array<SupportWindow, kPixels>& supports) {
  SupportSums sums;
  sum_supports(at, stride, window, tolerance, sums);
  // A sample is scale * (byte - 128), so that its sums follow from those of bytes.
  const std::int32_t scale = 1 << (16 - shift);
  for (std::size_t i = 0; i < kPixels; ++i) {
    const auto n = static_cast<std::int32_t>(sums.samples[i]);
    const std::int32_t red = static_cast<std::int32_t>(sums.red_blue[i] & 0xffffU);
    const std::int32_t green = static_cast<std::int32_t>(sums.green[i]);
    const std::int32_t blue = static_cast<std::int32_t>(sums.red_blue[i] >> 16);
    const std::int32_t squares =
        static_cast<std::int32_t>(sums.squares[i]) - 256 * (red + green + blue) + 3 * 128 * 128 * n;
    const ReferenceSums samples{{scale * (red - 128 * n), scale * (green - 128 * n), scale * (blue - 128 * n)},
                                scale * scale * squares};
    supports[i] = support_of(samples, n, tolerance);
  }
}

}  // namespace

Grid<SupportWindow> make_support_windows(const PaddedImage& image, int window, int tolerance, SimdLevel simd) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  Grid<SupportWindow> windows(image.width, image.height);
  const int count = image.width - 2 * radius;  // in a row
  const auto form = simd_form<find_supports>(simd);
  const auto take = [&](int x, int y, const SupportWindow& support) {
    windows.at(x, y) = support.samples >= least_samples(window) ? support : least_support(image, x, y, window, shift);
  };
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    constexpr int kStep = static_cast<int>(kPixels);
    if (count < kStep) {
      for (int x = radius; x < radius + count; ++x) take(x, y, support_within(image, x, y, window, shift, tolerance));
      return;
    }
    std::array<SupportWindow, kPixels> supports;
    for (int done = 0; done < count; done += kStep) {
      const int x = radius + std::min(done, count - kStep);  // the last ones overlap
      form(image.pixels.data() + std::ptrdiff_t{y} * image.stride() + x, image.stride(), window, tolerance, shift,
           supports);
      for (int i = 0; i < kStep; ++i) take(x + i, y, supports[static_cast<std::size_t>(i)]);
    }
  });
  return windows;
}

}  // namespace quorum
