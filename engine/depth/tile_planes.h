// Which planes a tile of the reference view tests, and in which of its parts. In the second pass neighboring pixels
// test different planes; a plane's pixels are covered by rectangles such that few other windows are swept with them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/grid.h"
#include "shaders/layout.h"

namespace quorum {

constexpr int kMaxTileSide = 64;

/// Pixels x..x_end-1, y..y_end-1 of the reference view.
struct Tile {
  int x = 0;
  int y = 0;
  int x_end = 0;
  int y_end = 0;
};

/// One plane, and a part of a tile where pixels test it.
struct TilePlane {
  int plane = 0;
  Tile part;
};

/// The work of one tile in one pass. An object may be used for tile after tile, and keeps its memory.
class TilePlanes {
 public:
  /// ranges: of all pixels of the view. tile: its sides at most kMaxTileSide. stride: planes between those tested, 1 or
  /// more; all ranges begin at multiples of it. window: pixels; rectangles that are swept apart share no samples, so
  /// the larger windows are, the fewer the rectangles.
  void collect(const Grid<PlaneRange>& ranges, const Tile& tile, int stride, int window);

  /// Planes rising. The parts of one plane share no pixel, and hold every pixel of the tile that tests it.
  [[nodiscard]] const std::vector<TilePlane>& planes() const { return planes_; }

  /// Pixel · depth that the ranges ask for.
  [[nodiscard]] std::uint64_t tests() const { return tests_; }

  /// Samples of one neighbor that the planes take, with the border of their windows.
  [[nodiscard]] std::uint64_t samples(int window) const;

 private:
  std::vector<TilePlane> planes_;
  std::uint64_t tests_ = 0;
  std::vector<std::uint64_t> pixels_;  ///< of each plane and row of the tile, a bit per pixel that tests the plane
};

}  // namespace quorum
