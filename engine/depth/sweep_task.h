// All that the sweep of one reference view needs, ready for any backend.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/depth/depth_planes.h"
#include "engine/depth/sweep_options.h"
#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

/// The small images of the coarse sweep beyond the bounds (outside_planes.h) are halved this often.
constexpr int kOutsideHalvings = 2;

/// neighbors and warps are of equal length, 2 or more, in the order of view selection (which fixes the order of float
/// sums). ranges has the size of the reference image.
struct SweepTask {
  std::shared_ptr<const PaddedImage> reference;
  std::vector<std::shared_ptr<const PaddedImage>> neighbors;
  std::vector<PlaneWarp> warps;
  DepthPlanes planes;
  Grid<PlaneRange> ranges;
  SweepOptions options;
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();  ///< of the reference view
  Grid<OutsidePlane> outside = {};  ///< of a small image's pixels; empty = no pixel may prefer what lies outside
  int outside_halvings = kOutsideHalvings;  ///< of the task's images, to become that one
  float max_tilt = 0.0F;                    ///< of slanted windows, see max_plane_tilt()

  [[nodiscard]] int neighbor_count() const { return static_cast<int>(neighbors.size()); }
};

}  // namespace quorum
