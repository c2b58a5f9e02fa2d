// What the depth stages give for one reference view.
#pragma once

#include <cstdint>

#include "engine/core/grid.h"

namespace quorum {

/// Per pixel of the reference view; all grids have its size. A pixel without a valid depth holds 0 in all of them.
struct DepthMap {
  Grid<float> depth;        ///< distance along the optical axis, scene units; 0 = none
  Grid<float> correlation;  ///< the paper's corr(d), 0..1
  Grid<float> confidence;   ///< the paper's conf(d), 0..1
};

}  // namespace quorum
