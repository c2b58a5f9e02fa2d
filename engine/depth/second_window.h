// A second, larger window for the pixels that the first one leaves without a depth: where texture is weak, more of it
// correlates (beyond the paper, which takes one window for all pixels, 4.2).
#pragma once

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"

namespace quorum {

/// The task with windows of options.second_window pixels, at pixels without a depth in the map and those around them,
/// whose planes may spread there.
SweepTask make_second_task(const SweepTask& task, const DepthMap& first);

/// Gives the pixels without a depth what the second map has there; all others stay. Maps of equal size and window
/// model.
void take_missing(const DepthMap& second, DepthMap& map);

}  // namespace quorum
