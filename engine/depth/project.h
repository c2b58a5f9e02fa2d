// Where a reference pixel lands in a neighbor view, on a plane of equal depth. Twin: shaders/lib/project.glsl.
#pragma once

#include <cstdint>

#include "engine/core/exact.h"
#include "shaders/layout.h"

namespace quorum {

/// A reference pixel in a neighbor view: position in pixels and 1 / z, which say nothing unless z > kMinDepthRatio.
struct WarpedPixel {
  float u;
  float v;
  float z;  ///< depth as a share of that in the reference
  float inverse_z;
};

/// Pixel (x, y) at an inverse depth.
[[gnu::always_inline]] inline WarpedPixel warp_pixel(const PlaneWarp& warp, int x, int y, float inverse_depth) {
  const float fx = static_cast<float>(x);
  const float fy = static_cast<float>(y);
  const float* m = warp.rotation;
  const float* t = warp.offset;
  const float px = m[0] * fx + (m[1] * fy + (m[2] + t[0] * inverse_depth));
  const float py = m[3] * fx + (m[4] * fy + (m[5] + t[1] * inverse_depth));
  const float pz = m[6] * fx + (m[7] * fy + (m[8] + t[2] * inverse_depth));
  const float inverse_z = reciprocal(pz > kMinDepthRatio ? pz : 1.0F);
  return {px * inverse_z, py * inverse_z, pz, inverse_z};
}

/// A position in a neighbor image, in 1/256 pixel. inside: 1 if the image has it and the point is before the camera;
/// all is 0 otherwise. Not a bool, for which the compiler would give up vectors.
struct Projection {
  int u = 0;
  int v = 0;
  std::int32_t inside = 0;
};

/// Projects pixel (x, y) on the plane at inverse_depth into a neighbor of the given size. margin: to the border of the
/// neighbor, which positions inside keep; 1/256 pixel.
[[gnu::always_inline]] inline Projection project(const PlaneWarp& warp, int x, int y, float inverse_depth,
                                                 int neighbor_width, int neighbor_height, int margin) {
  const WarpedPixel at = warp_pixel(warp, x, y, inverse_depth);
  const float u = at.u * static_cast<float>(kPositionScale) + 0.5F;
  const float v = at.v * static_cast<float>(kPositionScale) + 0.5F;
  const float least = static_cast<float>(margin);
  const bool inside = (at.z > kMinDepthRatio) & (u >= least) & (v >= least) &
                      (u < static_cast<float>((neighbor_width - 1) * kPositionScale + 1 - margin)) &
                      (v < static_cast<float>((neighbor_height - 1) * kPositionScale + 1 - margin));
  return {static_cast<int>(inside ? u : 0.0F), static_cast<int>(inside ? v : 0.0F), inside ? 1 : 0};
}

}  // namespace quorum
