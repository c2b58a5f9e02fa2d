// Depth from images of half the size where those of full size give none: with weak texture, or gloss, a window that
// covers four times as much still correlates (beyond the paper, which takes one window for all pixels, 4.2).
#pragma once

#include <vector>

#include "engine/depth/depth_map.h"
#include "engine/depth/small_images.h"
#include "engine/depth/sweep_task.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The task with images of half the size and planes twice as far apart, at pixels of which one has no depth in the map,
/// and those around them, whose planes may spread there. It may be run on any backend. reference, neighbors: the views
/// of the task. images: where the small ones are kept.
SweepTask make_half_task(const SweepTask& task, const DepthMap& full, const View& reference,
                         const std::vector<const View*>& neighbors, SmallImages& images);

/// Gives the pixels without a depth those of the half size, on their planes, that correlate well and lie inside a patch
/// of it, with a quarter of their confidence: a surface that full size sees, here or in another view, outweighs them.
/// task: of full size. half, coarse: the other one, and its result.
void take_from_half(const SweepTask& task, const SweepTask& half, const DepthMap& coarse, DepthMap& map);

}  // namespace quorum
