#include "engine/depth/second_window.h"

#include <algorithm>

#include "engine/core/check.h"

namespace quorum {

SweepTask make_second_task(const SweepTask& task, const DepthMap& first) {
  // Three rounds of refine_planes, which look three pixels far; other models look at each pixel by itself.
  const int reach = task.options.is_slanted() ? 9 : 0;
  QUORUM_CHECK_EQ(first.depth.values.size(), task.ranges.values.size());
  SweepTask second = task;
  second.options.window = task.options.second_window;
  const int width = task.ranges.width;
  const int height = task.ranges.height;
  const int radius = second.options.window / 2;
  std::fill(second.ranges.values.begin(), second.ranges.values.end(), PlaneRange{1, 0});
  for (int y = radius; y < height - radius; ++y) {
    for (int x = radius; x < width - radius; ++x) {
      if (first.depth.at(x, y) != 0.0F || task.ranges.at(x, y).first > task.ranges.at(x, y).last) continue;
      for (int v = std::max(y - reach, radius); v <= std::min(y + reach, height - 1 - radius); ++v) {
        const int left = std::max(x - reach, radius);
        const int right = std::min(x + reach, width - 1 - radius);
        std::copy(&task.ranges.at(left, v), &task.ranges.at(right, v) + 1, &second.ranges.at(left, v));
      }
    }
  }
  return second;
}

void take_missing(const DepthMap& second, DepthMap& map) {
  QUORUM_CHECK_EQ(second.depth.values.size(), map.depth.values.size());
  QUORUM_CHECK_EQ(second.normal.values.size(), map.normal.values.size());
  for (std::size_t pixel = 0; pixel < map.depth.values.size(); ++pixel) {
    if (map.depth.values[pixel] != 0.0F) continue;
    map.depth.values[pixel] = second.depth.values[pixel];
    map.correlation.values[pixel] = second.correlation.values[pixel];
    map.confidence.values[pixel] = second.confidence.values[pixel];
    if (!map.normal.empty()) map.normal.values[pixel] = second.normal.values[pixel];
  }
}

}  // namespace quorum
