#include "engine/mesh/drop_specks.h"

#include <vector>

#include "engine/mesh/disjoint_sets.h"
#include "engine/volume/cell.h"

namespace quorum {

void drop_specks(const Grid<float>& depth, float max_step, int least_pixels, Grid<float>& certainty) {
  constexpr float kSteeper = 2.5F;    // so that what turns away is not torn to pieces
  constexpr double kConfirmed = 0.6;  // a depth of which no other view says anything has 0.52
  if (least_pixels <= 0) return;
  DisjointSets sets(depth.values.size());
  const auto number = [&](int x, int y) { return static_cast<std::uint32_t>(y * depth.width + x); };
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float here = depth.at(x, y);
      if (x + 1 < depth.width && joined(here, depth.at(x + 1, y), kSteeper * max_step, 1.0F))
        sets.join(number(x, y), number(x + 1, y));
      if (y + 1 < depth.height && joined(here, depth.at(x, y + 1), kSteeper * max_step, 1.0F))
        sets.join(number(x, y), number(x, y + 1));
    }
  }
  // Certainties are multiples of 1/256, so their sums are exact in any order.
  std::vector<int> pixels(depth.values.size());
  std::vector<double> sum(depth.values.size());
  for (std::uint32_t pixel = 0; pixel < depth.values.size(); ++pixel) {
    const std::uint32_t patch = sets.find(pixel);
    ++pixels[patch];
    sum[patch] += static_cast<double>(certainty.values[pixel]);
  }
  for (std::uint32_t pixel = 0; pixel < depth.values.size(); ++pixel) {
    const std::uint32_t patch = sets.find(pixel);
    if (pixels[patch] < least_pixels && sum[patch] < kConfirmed * pixels[patch]) certainty.values[pixel] = 0.0F;
  }
}

void leave_out_dropped(const Grid<float>& certainty, Grid<float>& depth) {
  for (std::size_t pixel = 0; pixel < depth.values.size(); ++pixel)
    if (certainty.values[pixel] <= 0.0F) depth.values[pixel] = 0.0F;
}

}  // namespace quorum
