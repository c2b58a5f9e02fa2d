// Where a window lands in a neighbor view when it lies on a tilted plane. Twin: engine/depth/place_window.h.
#include "lib/project.glsl"

// Center and steps to the next sample, in 1/kPlacementScale pixel. seen: the neighbor sees the whole window.
struct WindowPlacement {
  ivec2 center;
  ivec2 step_x;
  ivec2 step_y;
  bool seen;
};

// At most kMaxStretch.
ivec2 placement_step(vec2 step) {
  const int bias = kMaxStretch * kPlacementScale;
  precise vec2 scaled = step * float(kPlacementScale) + (float(bias) + 0.5);
  return ivec2(scaled) - bias;
}

WindowPlacement place_window(PlaneWarp warp, int x, int y, float inverse_depth, float slope_x, float slope_y,
                             int radius, int neighbor_width, int neighbor_height) {
  WarpedPixel pixel = warp_pixel(warp, x, y, inverse_depth);
  float u = pixel.u;
  float v = pixel.v;
  float inverse_z = pixel.inverse_z;
  precise float z_x = warp.rotation[6] + warp.offset[2] * slope_x;
  precise float z_y = warp.rotation[7] + warp.offset[2] * slope_y;
  precise float u_x = ((warp.rotation[0] + warp.offset[0] * slope_x) - u * z_x) * inverse_z;
  precise float v_x = ((warp.rotation[3] + warp.offset[1] * slope_x) - v * z_x) * inverse_z;
  precise float u_y = ((warp.rotation[1] + warp.offset[0] * slope_y) - u * z_y) * inverse_z;
  precise float v_y = ((warp.rotation[4] + warp.offset[1] * slope_y) - v * z_y) * inverse_z;
  vec4 steps = vec4(u_x, v_x, u_y, v_y);
  bool on_image = pixel.z > kMinDepthRatio && u >= 0.0 && v >= 0.0 && u < float(neighbor_width) &&
                  v < float(neighbor_height) &&
                  all(greaterThanEqual(steps, vec4(-kMaxStretch))) && all(lessThanEqual(steps, vec4(kMaxStretch)));
  if (!on_image) return WindowPlacement(ivec2(0), ivec2(0), ivec2(0), false);
  // 1/512 pixel, so that a shift rounds to 1/256 pixel, and a half to round to the next integer.
  precise vec2 center = vec2(u, v) * float(kPlacementScale) + 8.5;
  WindowPlacement at = WindowPlacement(ivec2(center), placement_step(steps.xy), placement_step(steps.zw), true);
  ivec2 reach = radius * (abs(at.step_x) + abs(at.step_y));
  const int rest = (1 << (kPlacementBits - kPositionBits)) - 1;
  ivec2 last = (ivec2(neighbor_width, neighbor_height) - 1) * kPlacementScale + rest;
  at.seen = all(greaterThanEqual(at.center, reach)) && all(lessThanEqual(at.center + reach, last));
  return at;
}

// Where the sample (dx, dy) of a window lands in the neighbor, in 1/256 pixel.
ivec2 place_sample(ivec2 center, ivec2 step_x, ivec2 step_y, int dx, int dy) {
  return (center + (dx * step_x + dy * step_y)) >> (kPlacementBits - kPositionBits);
}
