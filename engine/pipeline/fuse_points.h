// Depth maps to one cloud of points, colored and with normals.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// One point for each place that RunOptions::cloud_views agree on, a view and its neighbors (select_views): the depth
/// of the neighbor differs by at most a hundredth, and its point falls within 1.5 pixels of the view's pixel. The
/// position is the mean of the agreeing points by confidence, the confidence their sum, the normal that of the view's
/// depth map (depth_normals), the color that of its image. A pixel that agreed with an earlier view makes no point of
/// its own, so the cloud depends on the order of the views, and on nothing else. Points of less than a quarter of the
/// median confidence are dropped. Holds the maps of a view and its neighbors, the cloud, and a bit for every pixel of
/// the scene, within the budget. Fails (kInput) if there is no depth map, or a file does not fit its view, (kMemory)
/// and (kStopped).
Expected<Mesh> fuse_points(Run& run);

/// Writes that cloud into the workspace. Fails as fuse_points, and (kInput) if it can't be written.
Expected<void> write_cloud(Run& run);

}  // namespace quorum
