#include "engine/depth/reference_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "engine/core/exact.h"

namespace quorum {
namespace {

/// Sums of the samples of each channel, and of their squares over all channels.
struct Sums {
  std::array<std::int32_t, 4> values = {};

  void add(const Sums& other, std::int32_t sign) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += sign * other.values[i];
  }
};

Sums sums_of_pixel(Rgba pixel, int shift) {
  const auto sample = [&](std::uint32_t value) {
    return static_cast<std::int32_t>((value << 16) >> shift) - (1 << (23 - shift));
  };
  const std::int32_t red = sample(red_of(pixel));
  const std::int32_t green = sample(green_of(pixel));
  const std::int32_t blue = sample(blue_of(pixel));
  return {{red, green, blue, red * red + green * green + blue * blue}};
}

}  // namespace

Grid<ReferenceWindow> make_reference_windows(const PaddedImage& image, int window) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  const double samples = window * window;
  Grid<ReferenceWindow> windows(image.width, image.height);
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    std::vector<Sums> columns(static_cast<std::size_t>(image.width));
    for (int dy = -radius; dy <= radius; ++dy)
      for (int x = 0; x < image.width; ++x)
        columns[static_cast<std::size_t>(x)].add(sums_of_pixel(image.at(x, y + dy), shift), 1);
    Sums sums;
    for (int x = 0; x < image.width; ++x) {
      sums.add(columns[static_cast<std::size_t>(x)], 1);
      if (x >= window) sums.add(columns[static_cast<std::size_t>(x - window)], -1);
      if (x < window - 1) continue;
      const auto [red, green, blue, squares] = sums.values;
      const auto product = [](std::int32_t sum) { return static_cast<double>(sum) * sum; };
      const double variance = samples * squares - (product(red) + product(green) + product(blue));
      windows.at(x - radius, y) = {{red, green, blue}, reciprocal_sqrt(float_from_integer(variance))};
    }
  });
  return windows;
}

}  // namespace quorum
