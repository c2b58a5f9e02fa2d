#include "engine/depth/plane_warp.h"

#include <Eigen/LU>

namespace quorum {

PlaneWarp make_plane_warp(const Camera& reference, const Camera& neighbor) {
  const Eigen::Matrix3d neighbor_from_reference = neighbor.camera_from_world * reference.camera_from_world.transpose();
  const Eigen::Matrix3d rotation = neighbor.intrinsics * neighbor_from_reference * reference.intrinsics.inverse();
  const Eigen::Vector3d offset =
      neighbor.intrinsics * (neighbor.translation - neighbor_from_reference * reference.translation);
  PlaneWarp warp;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      warp.rotation[3 * row + column] = static_cast<float>(rotation(row, column));
    warp.offset[row] = static_cast<float>(offset(row));
  }
  return warp;
}

}  // namespace quorum
