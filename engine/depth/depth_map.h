// What the depth stages give for one reference view.
#pragma once

#include <Eigen/Core>

#include "engine/core/grid.h"

namespace quorum {

/// Per pixel of the reference view; all grids have its size. A pixel without a valid depth holds 0 in all of them.
struct DepthMap {
  Grid<float> depth;        ///< distance along the optical axis, scene units; 0 = none
  Grid<float> correlation;  ///< the paper's corr(d), 0..1
  Grid<float> confidence;   ///< the paper's conf(d), 0..1
  /// Unit normals in the camera frame, toward the camera, of the windows' planes; empty if windows were not tilted, or
  /// if they were not asked for.
  Grid<Eigen::Vector3f> normal;
};

}  // namespace quorum
