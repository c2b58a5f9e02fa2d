// The first plane of every pixel: the one that fits the depths of the first pass around it.
#pragma once

#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/depth/depth_planes.h"

namespace quorum {

/// How far the depths that a plane is fitted to may lie from that of its pixel, 1 / scene units: three steps of the
/// first pass.
float fit_limit(const DepthPlanes& planes);

/// Per pixel the plane through the depths of the votes in the 7 × 7 pixels around it that lie within three steps of the
/// first pass of its own, by least squares; a plane without slopes where fewer than six do or all lie on a line.
/// Nothing where the pixel has no vote. Float operations in a fixed order: the same bytes everywhere. Twin:
/// shaders/first_planes.comp.
Grid<PlaneTrial> fit_planes(const Grid<PixelVote>& votes, const DepthPlanes& planes,
                            SimdLevel simd = best_simd_level());

}  // namespace quorum
