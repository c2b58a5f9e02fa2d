// The depth sweep of one reference view (the paper, sections 2.1 and 4.1): NCC of every window on every plane against
// every neighbor, votes, and the best depth. Twin of shaders/sweep_depth.comp.
#pragma once

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"

namespace quorum {

/// NCC of the window around reference pixel (x, y) on a plane against one neighbor; kNoNcc where the neighbor does not
/// see the whole window. One window at a time, in the words of the paper: what the fast sweep and the kernels must
/// equal.
float window_ncc(const SweepTask& task, int neighbor, int x, int y, int plane);

/// Below every threshold: the neighbor does not see the window.
constexpr float kNoNcc = -1.0F;

/// Instructions that the sweep may use. All give the same bytes.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// The most that this processor has.
SimdLevel best_simd_level();

/// How the CPU does its work; none of it changes a byte of the result.
struct CpuSweepOptions {
  SimdLevel simd = best_simd_level();
  int tile_width = 64;   ///< pixels, 8..64
  int tile_height = 16;  ///< pixels, 1..64
};

/// Votes of the best plane per pixel over one pass: each pixel tests the planes of its range, every stride-th.
Grid<PixelVote> sweep_planes(const SweepTask& task, const Grid<PlaneRange>& ranges, int stride,
                             const CpuSweepOptions& cpu);

/// Both passes of the paper: planes of the first pass, then the planes around each pixel's best one.
DepthMap sweep_depth(const SweepTask& task, const CpuSweepOptions& cpu);

}  // namespace quorum
