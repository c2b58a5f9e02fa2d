#include "engine/depth/plane_warp.h"

#include <Eigen/LU>

#include "engine/core/exact.h"

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

Projection project(const PlaneWarp& warp, int x, int y, float inverse_depth, int neighbor_width, int neighbor_height) {
  const float fx = static_cast<float>(x);
  const float fy = static_cast<float>(y);
  const float* m = warp.rotation;
  const float px = m[0] * fx + (m[1] * fy + (m[2] + warp.offset[0] * inverse_depth));
  const float py = m[3] * fx + (m[4] * fy + (m[5] + warp.offset[1] * inverse_depth));
  const float pz = m[6] * fx + (m[7] * fy + (m[8] + warp.offset[2] * inverse_depth));
  const bool before = pz > kMinDepthRatio;
  const float inverse_z = reciprocal(before ? pz : 1.0F);
  const float u = (px * inverse_z) * static_cast<float>(kPositionScale) + 0.5F;
  const float v = (py * inverse_z) * static_cast<float>(kPositionScale) + 0.5F;
  const bool inside = before && u >= 0.0F && v >= 0.0F &&
                      u < static_cast<float>((neighbor_width - 1) * kPositionScale + 1) &&
                      v < static_cast<float>((neighbor_height - 1) * kPositionScale + 1);
  return inside ? Projection{static_cast<int>(u), static_cast<int>(v), true} : Projection{};
}

}  // namespace quorum
