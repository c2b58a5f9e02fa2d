// The depth sweep of one reference view (the paper, sections 2.1 and 4.1): NCC of every window on every plane against
// every neighbor, votes, and the best depth. Twin of shaders/sweep_depth.comp.
#pragma once

#include "engine/core/simd.h"
#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"

namespace quorum {

/// NCC of the window around reference pixel (x, y) on a plane against one neighbor; kNoNcc where the neighbor does not
/// see the whole window. One window at a time, in the words of the paper: what the fast sweep and the kernels must
/// equal.
float window_ncc(const SweepTask& task, int neighbor, int x, int y, int plane);

/// How the CPU does its work; none of it changes a byte of the result.
struct CpuSweepOptions {
  SimdLevel simd = best_simd_level();
  int tile_width = 64;   ///< pixels, 8..64
  int tile_height = 16;  ///< pixels, 1..64
};

/// What one pass had to do and did. The counts follow from the task and the tiles alone, not from time or threads.
struct PassWork {
  std::uint64_t windows = 0;  ///< pixel · depth · neighbor that the ranges ask for
  std::uint64_t samples = 0;  ///< of neighbors, interpolated; with borders of tiles and pixels that a tile takes along
  double cpu_seconds = 0.0;   ///< of the threads that compute
};

struct SweepWork {
  PassWork sweep;   ///< first pass
  PassWork refine;  ///< second pass, or tilted planes
};

/// Votes of the best plane per pixel over one pass: each pixel tests the planes of its range, every stride-th.
/// Adds to work, if given.
Grid<PixelVote> sweep_planes(const SweepTask& task, const Grid<PlaneRange>& ranges, int stride,
                             const CpuSweepOptions& cpu, PassWork* work = nullptr);

/// Both passes of the paper: planes of the first pass, then the planes around each pixel's best one, or tilted planes
/// (refine_planes.h) if the windows are slanted. work: if given, receives what was done.
DepthMap sweep_depth(const SweepTask& task, const CpuSweepOptions& cpu, SweepWork* work = nullptr);

}  // namespace quorum
