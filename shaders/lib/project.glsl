// Where a reference pixel lands in a neighbor view, on a plane of equal depth. Twin: engine/depth/project.h.
#ifndef QUORUM_PROJECT_GLSL
#define QUORUM_PROJECT_GLSL
#include "lib/exact.glsl"

// A reference pixel in a neighbor view: position in pixels and 1 / z, which say nothing unless z > kMinDepthRatio.
struct WarpedPixel {
  float u;
  float v;
  float z;  // depth as a share of that in the reference
  float inverse_z;
};

WarpedPixel warp_pixel(PlaneWarp warp, int x, int y, float inverse_depth) {
  float fx = float(x);
  float fy = float(y);
  precise float px =
      warp.rotation[0] * fx + (warp.rotation[1] * fy + (warp.rotation[2] + warp.offset[0] * inverse_depth));
  precise float py =
      warp.rotation[3] * fx + (warp.rotation[4] * fy + (warp.rotation[5] + warp.offset[1] * inverse_depth));
  precise float pz =
      warp.rotation[6] * fx + (warp.rotation[7] * fy + (warp.rotation[8] + warp.offset[2] * inverse_depth));
  float inverse_z = reciprocal(pz > kMinDepthRatio ? pz : 1.0);
  precise float u = px * inverse_z;
  precise float v = py * inverse_z;
  return WarpedPixel(u, v, pz, inverse_z);
}

// A position in 1/256 pixel; (0, 0) and not inside where the neighbor does not see the point.
struct Projection {
  int u;
  int v;
  bool inside;
};

// margin: to the border of the neighbor, which positions inside keep; 1/256 pixel.
Projection project(PlaneWarp warp, int x, int y, float inverse_depth, int neighbor_width, int neighbor_height,
                   int margin) {
  WarpedPixel at = warp_pixel(warp, x, y, inverse_depth);
  precise float u = at.u * float(kPositionScale) + 0.5;
  precise float v = at.v * float(kPositionScale) + 0.5;
  float least = float(margin);
  bool inside = at.z > kMinDepthRatio && u >= least && v >= least &&
                u < float((neighbor_width - 1) * kPositionScale + 1 - margin) &&
                v < float((neighbor_height - 1) * kPositionScale + 1 - margin);
  return inside ? Projection(int(u), int(v), true) : Projection(0, 0, false);
}

#endif
