// The supports of a tile's pixels, packed once for all planes that the tile tries.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/depth/sweep_task.h"
#include "engine/depth/tile_planes.h"

namespace quorum {

/// Samples of the reference around each pixel of a tile.
class TileSupports {
 public:
  /// windows: as make_support_windows gives them. An object may be used for tile after tile, and keeps its memory.
  void pack(const SweepTask& task, const Grid<SupportWindow>& windows, const Tile& tile, SimdLevel simd);

  /// The samples of the window's place `index` (row by row), pixel by pixel, row by row: 16 bits each for red, green
  /// and blue as sample_pixel gives them, and all ones above; 0 where the place is no part of the support.
  [[nodiscard]] const std::uint64_t* samples(int index) const {
    return samples_.data() + static_cast<std::size_t>(index) * stride_;
  }
  /// Where pixel (x, y) of the image stands among them.
  [[nodiscard]] int pixel(int x, int y) const { return (y - tile_.y) * (tile_.x_end - tile_.x) + x - tile_.x; }

 private:
  Tile tile_;
  std::size_t stride_ = 0;  ///< samples of a place
  std::vector<std::uint64_t> samples_;
  std::vector<std::int32_t> most_;  ///< largest differences of a row's supports
};

}  // namespace quorum
