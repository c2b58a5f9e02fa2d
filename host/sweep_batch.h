// The work of a pass of the sweep in batches: blocks of pixels, each with the planes that any of its pixels tests.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/grid.h"
#include "shaders/layout.h"

namespace quorum {

/// A block's size, pixels: width 4, 8 or 16, height a divisor of kBlockMultiple.
struct BlockSize {
  int width = 8;
  int height = 8;

  [[nodiscard]] int pixels() const { return width * height; }
};

/// What one submission sweeps. Items of a block stand together, planes rising.
struct SweepBatch {
  std::vector<SweepBlock> blocks;
  std::vector<SweepItem> items;
};

/// Walks the blocks of a view from the upper left, row by row. Each block meets its planes in rising order, in one
/// batch or in several, so that votes do not depend on the batches.
class SweepBatches {
 public:
  /// ranges, inverse_depths: must outlive the object. stride: planes between those tested; 1 or more.
  SweepBatches(const Grid<PlaneRange>& ranges, std::span<const float> inverse_depths, BlockSize block, int stride);

  /// The next batch; empty when all are done. most_items: 1 or more. most_planes: of one block, 1 or more.
  SweepBatch next(std::int64_t most_items, std::int64_t most_planes);

 private:
  /// Planes that some pixel of the current block tests, into planes_.
  void collect_planes();

  const Grid<PlaneRange>* ranges_;
  std::span<const float> inverse_depths_;
  BlockSize block_;
  int stride_;
  int x_ = 0;  ///< of the current block
  int y_ = 0;
  std::vector<int> planes_;      ///< of the current block
  std::size_t planes_done_ = 0;  ///< of them
  std::vector<int> changes_;     ///< workspace of collect_planes
};

}  // namespace quorum
