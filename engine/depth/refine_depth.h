// The second pass of the paper (section 4.1): the planes at a fraction of the step around each pixel's best plane.
// All devices sweep these ranges as they do those of the first pass.
#pragma once

#include "engine/depth/sweep_task.h"

namespace quorum {

/// The planes strictly between the two planes of the first pass beside each pixel's best one: (d' - Δd, d' + Δd). Empty
/// where the first pass found none.
Grid<PlaneRange> refine_ranges(const Grid<PixelVote>& votes, const DepthPlanes& planes);

}  // namespace quorum
