// Depth maps as a dense workspace of COLMAP, on which `colmap stereo_fusion` and `colmap poisson_mesher` go on. Neither
// needs CUDA.
#pragma once

#include "engine/pipeline/run.h"

namespace quorum {

/// Writes what COLMAP's image_undistorter and patch_match_stereo would leave into colmap/ of the workspace:
///   images/               the photographs, as they are or undistorted (.png)
///   sparse/*.bin          cameras (PINHOLE), poses, and points with the views that see them
///   stereo/depth_maps/    NAME.geometric.bin of every view with a depth map
///   stereo/normal_maps/   likewise, from the depth maps (depth_normals)
///   stereo/patch-match.cfg, stereo/fusion.cfg
/// stereo_fusion compares views that share points. A scene without points gets some from its depth maps: a grid of
/// pixels, seen by the neighbors whose depth map agrees.
/// Fails (kInput) if a file can't be read or written, there is no depth map, or a camera has skew, which PINHOLE has
/// not; and (kStopped).
Expected<void> write_colmap_workspace(Run& run);

/// Fails as write_colmap_workspace would, now, as far as that can be seen beforehand.
Expected<void> check_colmap_workspace(const Run& run);

}  // namespace quorum
