// The weights of a range surface's vertices: the confidence, times the cosine of the angle between surface and line of
// sight, times the square of a ramp that falls toward borders of the surface (the paper, section 2.2; Curless and Levoy
// 1996). Each factor can be left out. Twin of shaders/weigh_surface.comp.
#pragma once

#include "engine/volume/range_surface.h"

namespace quorum {

WeighSurfaceParams make_weigh_surface_params(const Camera& camera, int width, int height, const FusionOptions& options);

/// A word per pixel: the weight, 0..kWeightScale, at least 1 at every corner of a triangle and 0 elsewhere; above its
/// kWeightBits the cosine that turns a distance along the line of sight into the distance that the volume takes, in
/// 1/kCosineScale, 0 where the weight is 0.
Grid<std::uint32_t> weigh_surface(const Grid<float>& depth, const Grid<float>& confidence,
                                  const Grid<std::uint32_t>& cells, const WeighSurfaceParams& params);

}  // namespace quorum
