// The plane with which every pixel of slanted windows begins. Twin: shaders/first_planes.comp, with fit_planes.
#pragma once

#include "engine/core/simd.h"
#include "engine/depth/sweep_task.h"

namespace quorum {

/// The planes with which the pixels of slanted windows begin: fitted to the first pass (fit_planes), or beyond the
/// bounds where task.outside has one of a higher correlation.
Grid<PlaneTrial> first_planes(const SweepTask& task, const Grid<PixelVote>& first_pass,
                              SimdLevel simd = best_simd_level());

}  // namespace quorum
