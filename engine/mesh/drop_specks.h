// Drops small patches of a depth map that no other view confirms. Where nothing matches, chance does, over a few
// windows side by side; a surface is larger, or other views see it, too.
#pragma once

#include "engine/core/grid.h"

namespace quorum {

/// Sets the certainty to 0, which means that a depth takes no part, in patches of fewer than least_pixels with a mean
/// certainty below 0.6. A patch is what steps of at most 2.5 times max_step join along rows and columns. depth,
/// certainty: of one view, of one size. max_step: as in RangeSurfaceParams. least_pixels: 0 = drop none.
void drop_specks(const Grid<float>& depth, float max_step, int least_pixels, Grid<float>& certainty);

/// Takes away the depths of certainty 0.
void leave_out_dropped(const Grid<float>& certainty, Grid<float>& depth);

}  // namespace quorum
