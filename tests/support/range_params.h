// Parameters of a range surface for tests that have no camera.
#pragma once

#include "shaders/layout.h"

namespace quorum {

/// Edges are held against their slope alone.
inline RangeSurfaceParams slope_alone(int width, int height, float max_step) {
  RangeSurfaceParams params{};
  params.width = width;
  params.height = height;
  params.max_step = max_step;
  return params;
}

}  // namespace quorum
