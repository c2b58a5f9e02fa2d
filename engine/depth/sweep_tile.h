// The sweep of one tile of the reference view. Windows on the plane of equal depth share their samples: each sample of
// a neighbor is warped once per plane, and all windows that contain it take it from running sums.
#pragma once

#include <vector>

#include "engine/depth/sweep_depth.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

constexpr int kMaxTileSide = 64;

/// Pixels x..x_end-1, y..y_end-1 of the reference view.
struct Tile {
  int x = 0;
  int y = 0;
  int x_end = 0;
  int y_end = 0;
};

/// One plane, and the part of a tile where some pixel tests it.
struct TilePlane {
  int plane = 0;
  int x = 0;
  int y = 0;
  int x_end = 0;
  int y_end = 0;
};

/// Votes for the given planes, ascending, at the pixels of a tile whose range holds them. Every window of the tile
/// whose range is not empty lies in the reference image. Equal to window_ncc and vote, byte by byte, at every SIMD
/// level.
void sweep_tile(const SweepTask& task, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, const VoteRule& rule, SimdLevel simd, Grid<PixelVote>& votes);

}  // namespace quorum
