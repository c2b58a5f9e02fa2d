// What lies beyond the bounds. A ray that leaves the box without meeting anything shows something farther away; inside
// the box nothing matches there but by chance, and chance makes shards. So a coarse sweep of small images looks from
// the near end of the bounds to infinity. Where it finds a plane beyond the bounds that correlates better than what the
// first pass found inside, the pixel begins with that plane; a pixel that ends with one beyond the bounds has no depth.
#pragma once

#include <vector>

#include "engine/core/bounds.h"
#include "engine/depth/depth_map.h"
#include "engine/depth/small_images.h"
#include "engine/depth/sweep_task.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The coarse sweep of a view: its images at a quarter of their size, planes that face the camera at four times the
/// distance of those of the first pass, from the nearest of these to infinity. One vote is enough. It may be run on any
/// backend. reference, neighbors: the views of the task. images: where the small ones are kept. Ranges are empty where
/// those of the task are.
SweepTask make_outside_task(const SweepTask& task, const View& reference, const std::vector<const View*>& neighbors,
                            const Bounds& bounds, SmallImages& images);

/// Per pixel of the coarse sweep the plane beyond the bounds that it found best. coarse: the task, map: its result.
Grid<OutsidePlane> outside_planes(const SweepTask& coarse, const DepthMap& map, const View& reference,
                                  const Bounds& bounds);

}  // namespace quorum
