// Tilted planes instead of depths: windows that lie on the surface (beyond the paper, whose windows face the camera).
// Every pixel starts with a plane that fits the first pass of the sweep around it. Then, in rounds, it tries the planes
// of pixels beside it and small steps of its own, and takes what raises the paper's conf(d) under the same quorum,
// valid before or not. A round reads the planes of the last one and of the pixel itself, so the result depends on no
// order, and nothing is random. Twin of shaders/refine_planes.comp and refine_planes_lanes.comp.
#pragma once

#include "engine/depth/depth_map.h"
#include "engine/depth/plane_moves.h"
#include "engine/depth/sweep_depth.h"

namespace quorum {

/// The best plane per pixel; kNoPlane where none has the votes. first_pass: votes of the sweep. Adds to work, if given:
/// windows are those of all planes that were tried.
Grid<PixelPlane> refine_planes(const SweepTask& task, const Grid<PixelVote>& first_pass, const CpuSweepOptions& cpu,
                               PassWork* work = nullptr);

/// The depth map that the planes of a task say, with normals. No depth where a plane lies beyond the bounds.
DepthMap depth_map_from_planes(const Grid<PixelPlane>& planes, const SweepTask& task);

}  // namespace quorum
