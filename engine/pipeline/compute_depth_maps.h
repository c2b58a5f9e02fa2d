// The first half of a run: a depth map for every view.
#pragma once

#include "engine/io/image_store.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// Everything that the sweep of one reference view needs. Fails as make_depth_planes does and (kInput) if an image is
/// bad.
Expected<SweepTask> make_sweep_task(const Scene& scene, int reference, const std::vector<int>& neighbors,
                                    const SweepOptions& options, ImageStore& images);

/// Neighbors that a view needs for a depth map (the paper, 4.3: every point is seen in at least three views).
constexpr std::size_t kLeastNeighbors = 2;

/// Depth maps of all views into the workspace; those that lie there and were made of the same are kept. A view with
/// fewer than two neighbors is noted and left out. Fails (kInput) if no view has two neighbors or an image is bad, as
/// the backend does, or kStopped.
Expected<void> compute_depth_maps(Run& run);

/// Fails (kInput) if the view has none in the workspace though it has neighbors.
Expected<void> check_depth_map_is_there(const Run& run, int view);

}  // namespace quorum
