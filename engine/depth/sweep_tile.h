// The sweep of one tile of the reference view. Windows on the plane of equal depth share their samples: each sample of
// a neighbor is warped once per plane, and all windows that contain it take it from running sums.
#pragma once

#include <vector>

#include "engine/depth/sweep_depth.h"
#include "engine/depth/tile_planes.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

/// Votes for the given planes, ascending, at the pixels of a tile whose range holds them; no pixel is in two parts of
/// one plane. Every window of the tile whose range is not empty lies in the reference image. Equal to window_ncc and
/// vote, byte by byte, at every SIMD level.
void sweep_tile(const SweepTask& task, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, const VoteRule& rule, SimdLevel simd, Grid<PixelVote>& votes);

}  // namespace quorum
