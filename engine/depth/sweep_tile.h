// The sweep of one tile of the reference view. Windows on the plane of equal depth share their samples: each sample of
// a neighbor is warped once per plane, and all windows that contain it take it from running sums.
#pragma once

#include <vector>

#include "engine/depth/sweep_depth.h"
#include "engine/depth/texel_columns.h"
#include "engine/depth/tile_planes.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

/// What the sweep of a view's tiles shares.
struct TileSweep {
  const SweepTask& task;
  VoteRule rule;
  SimdLevel simd;
  std::vector<TexelColumns> neighbors;  ///< those of the task; empty if nothing reads them so
};
TileSweep make_tile_sweep(const SweepTask& task, SimdLevel simd);

/// Votes for the given planes, ascending, at the pixels of a tile whose range holds them; no pixel is in two parts of
/// one plane. Every window of the tile whose range is not empty lies in the reference image. Equal to window_ncc and
/// vote, byte by byte, at every SIMD level.
void sweep_tile(const TileSweep& sweep, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, Grid<PixelVote>& votes);

}  // namespace quorum
