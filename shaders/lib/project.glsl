// Where a reference pixel lands in a neighbor view. Twin: engine/depth/plane_warp.h.
#include "lib/exact.glsl"

// A position in 1/256 pixel; (0, 0) and not inside where the neighbor does not see the point.
struct Projection {
  int u;
  int v;
  bool inside;
};

Projection project(PlaneWarp warp, int x, int y, float inverse_depth, int neighbor_width, int neighbor_height) {
  float fx = float(x);
  float fy = float(y);
  precise float px = warp.rotation[0] * fx + (warp.rotation[1] * fy + (warp.rotation[2] + warp.offset[0] * inverse_depth));
  precise float py = warp.rotation[3] * fx + (warp.rotation[4] * fy + (warp.rotation[5] + warp.offset[1] * inverse_depth));
  precise float pz = warp.rotation[6] * fx + (warp.rotation[7] * fy + (warp.rotation[8] + warp.offset[2] * inverse_depth));
  bool before = pz > kMinDepthRatio;
  float inverse_z = reciprocal(before ? pz : 1.0);
  precise float u = (px * inverse_z) * float(kPositionScale) + 0.5;
  precise float v = (py * inverse_z) * float(kPositionScale) + 0.5;
  bool inside = before && u >= 0.0 && v >= 0.0 && u < float((neighbor_width - 1) * kPositionScale + 1) &&
                v < float((neighbor_height - 1) * kPositionScale + 1);
  return inside ? Projection(int(u), int(v), true) : Projection(0, 0, false);
}
