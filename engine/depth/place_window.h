// Where a window lands in a neighbor view when it lies on a tilted plane: the projection of its center and, since a
// window is small, its derivative there. Perspective within a window of 15 pixels moves a sample by about a hundredth
// of a pixel, and without it a sample's position is two integer additions. Twin: shaders/lib/place_window.glsl.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/core/simd.h"
#include "engine/depth/project.h"
#include "shaders/layout.h"

namespace quorum {

/// Center (u, v) and steps to the next sample along x and y, all in 1/kPlacementScale pixel; the center is rounded so
/// that a shift gives 1/256 pixel. seen: the neighbor sees the whole window; all else is 0 if not.
struct WindowPlacement {
  int u = 0;
  int v = 0;
  int u_x = 0;
  int v_x = 0;
  int u_y = 0;
  int v_y = 0;
  bool seen = false;
};

/// Derivative of a projected coordinate in 1/kPlacementScale pixel. At most kMaxStretch.
[[gnu::always_inline]] inline int placement_step(float step) {
  constexpr float kScale = static_cast<float>(kPlacementScale);
  constexpr int kBias = kMaxStretch * kPlacementScale;
  return static_cast<int>(step * kScale + (static_cast<float>(kBias) + 0.5F)) - kBias;
}

/// The window of the given radius around reference pixel (x, y) on a plane, in a neighbor of the given size. Cannot
/// fail.
[[gnu::always_inline]] inline WindowPlacement place_window(const PlaneWarp& warp, int x, int y, float inverse_depth,
                                                           float slope_x, float slope_y, int radius, int neighbor_width,
                                                           int neighbor_height) {
  const auto [u, v, z, inverse_z] = warp_pixel(warp, x, y, inverse_depth);
  const float* m = warp.rotation;
  const float* t = warp.offset;
  const float z_x = m[6] + t[2] * slope_x;
  const float z_y = m[7] + t[2] * slope_y;
  const float u_x = ((m[0] + t[0] * slope_x) - u * z_x) * inverse_z;
  const float v_x = ((m[3] + t[1] * slope_x) - v * z_x) * inverse_z;
  const float u_y = ((m[1] + t[0] * slope_y) - u * z_y) * inverse_z;
  const float v_y = ((m[4] + t[1] * slope_y) - v * z_y) * inverse_z;
  constexpr float kLimit = static_cast<float>(kMaxStretch);
  const auto moderate = [](float step) { return (step >= -kLimit) & (step <= kLimit); };
  const bool on_image = (z > kMinDepthRatio) & (u >= 0.0F) & (v >= 0.0F) & (u < static_cast<float>(neighbor_width)) &
                        (v < static_cast<float>(neighbor_height)) & moderate(u_x) & moderate(v_x) & moderate(u_y) &
                        moderate(v_y);
  constexpr float kHalfOfSample = 8.5F;  // 1/512 pixel, and a half to round to the next integer
  const auto center = [on_image](float position) {
    return static_cast<int>(kept_if(on_image, position) * static_cast<float>(kPlacementScale) + kHalfOfSample);
  };
  WindowPlacement at;
  at.u = center(u);
  at.v = center(v);
  at.u_x = placement_step(kept_if(on_image, u_x));
  at.v_x = placement_step(kept_if(on_image, v_x));
  at.u_y = placement_step(kept_if(on_image, u_y));
  at.v_y = placement_step(kept_if(on_image, v_y));
  const auto size = [](int step) { return std::max(step, -step); };
  const int reach_u = radius * (size(at.u_x) + size(at.u_y));
  const int reach_v = radius * (size(at.v_x) + size(at.v_y));
  constexpr int kRest = (1 << (kPlacementBits - kPositionBits)) - 1;
  at.seen = on_image & (at.u >= reach_u) & (at.v >= reach_v) &
            (at.u + reach_u <= (neighbor_width - 1) * kPlacementScale + kRest) &
            (at.v + reach_v <= (neighbor_height - 1) * kPlacementScale + kRest);
  return at;
}

/// Where the sample (dx, dy) of a window lands along one axis of the neighbor, in 1/256 pixel. center, step_x, step_y:
/// of its placement along that axis.
[[gnu::always_inline]] inline int place_sample(int center, int step_x, int step_y, int dx, int dy) {
  return (center + (dx * step_x + dy * step_y)) >> (kPlacementBits - kPositionBits);
}

}  // namespace quorum
