// The planes that a move proposes to a row of pixels, side by side: vectors of what plane_moves.h says of one.
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/depth/plane_moves.h"
#include "shaders/layout.h"

namespace quorum {

/// The planes of pixels, each quantity for itself. As in PixelPlane.
struct PlaneGrid {
  Grid<float> inverse_depth;
  Grid<float> slope_x;
  Grid<float> slope_y;
  Grid<std::int32_t> taken_by;

  PlaneGrid(int width, int height)
      : inverse_depth(width, height), slope_x(width, height), slope_y(width, height), taken_by(width, height) {}
};

/// What a move proposes to pixels side by side.
struct PlaneProposals {
  static constexpr int kCapacity = 64;
  std::array<float, kCapacity> inverse_depth;
  std::array<float, kCapacity> slope_x;
  std::array<float, kCapacity> slope_y;
  std::array<std::int32_t, kCapacity> may_take;  ///< not 0: a plane that the pixel may take
};

/// The proposals for `count` pixels from (x, y) on, until this thread's next call. last, best: the planes of the last
/// round, and the best ones so far. Equal at every SIMD level.
const PlaneProposals& propose_planes(const PlaneMove& move, const PlaneGrid& last, const PlaneGrid& best,
                                     const Grid<InverseDepthRange>& ranges, float max_tilt, int x, int y, int count,
                                     SimdLevel simd);

}  // namespace quorum
