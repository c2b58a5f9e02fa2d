#include "engine/depth/reference_windows.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace quorum {
namespace {

void add(ReferenceSums& sums, const ReferenceSums& other, int sign) {
  for (int channel = 0; channel < 3; ++channel) sums.sum[channel] += sign * other.sum[channel];
  sums.squares += sign * other.squares;
}

}  // namespace

Grid<ReferenceWindow> make_reference_windows(const PaddedImage& image, int window) {
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  Grid<ReferenceWindow> windows(image.width, image.height);
  tbb::parallel_for(radius, std::max(image.height - radius, radius), [&](int y) {
    std::vector<ReferenceSums> columns(static_cast<std::size_t>(image.width));
    for (int dy = -radius; dy <= radius; ++dy)
      for (int x = 0; x < image.width; ++x)
        add_sample(columns[static_cast<std::size_t>(x)], sample_pixel(image.at(x, y + dy), shift));
    ReferenceSums sums;
    for (int x = 0; x < image.width; ++x) {
      add(sums, columns[static_cast<std::size_t>(x)], 1);
      if (x >= window) add(sums, columns[static_cast<std::size_t>(x - window)], -1);
      if (x >= window - 1) windows.at(x - radius, y) = window_from_sums(sums, window * window);
    }
  });
  return windows;
}

}  // namespace quorum
