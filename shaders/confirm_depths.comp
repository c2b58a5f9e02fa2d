// Adds what one other view's depth map says of each depth of a view: whether it sees the same surface there, or looks
// through it. Twin: engine/volume/confirm_depths.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { ConfirmDepthsParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer OtherDepth { float other_depth[]; };
layout(std430, binding = 2) buffer Support { int support[]; };

float surface_depth(float u, float v) {
  int x = int(u);
  int y = int(v);
  precise float fx = u - float(x);
  precise float fy = v - float(y);
  int corner = y * p.other_width + x;
  float d0 = other_depth[corner];
  float d1 = other_depth[corner + 1];
  float d2 = other_depth[corner + p.other_width];
  float d3 = other_depth[corner + p.other_width + 1];
  bool whole = joined(d0, d1, p.other_max_step, 1.0) && joined(d0, d2, p.other_max_step, 1.0) &&
               joined(d1, d3, p.other_max_step, 1.0) && joined(d2, d3, p.other_max_step, 1.0);
  if (!whole) return fy < 0.5 ? (fx < 0.5 ? d0 : d1) : (fx < 0.5 ? d2 : d3);
  precise float top = d0 + fx * (d1 - d0);
  precise float bottom = d2 + fx * (d3 - d2);
  precise float result = top + fy * (bottom - top);
  return result;
}

int support_of(int x, int y, float d) {
  PlaneWarp warp = p.warp;
  float fx = float(x);
  float fy = float(y);
  precise float rx = warp.rotation[0] * fx + (warp.rotation[1] * fy + warp.rotation[2]);
  precise float ry = warp.rotation[3] * fx + (warp.rotation[4] * fy + warp.rotation[5]);
  precise float rz = warp.rotation[6] * fx + (warp.rotation[7] * fy + warp.rotation[8]);
  precise float z = rz * d + warp.offset[2];
  precise float least = kMinDepthRatio * d;
  if (!(z > least)) return 0;
  float inverse_z = reciprocal(z);
  precise float u = (rx * d + warp.offset[0]) * inverse_z;
  precise float v = (ry * d + warp.offset[1]) * inverse_z;
  if (!(u >= 0.0 && v >= 0.0 && u < float(p.other_width - 1) && v < float(p.other_height - 1))) return 0;
  float seen = surface_depth(u, v);
  if (!(seen > 0.0)) return 0;
  precise float footprint = p.footprint * z;
  precise float behind = seen - z;
  float apart = abs(behind);
  precise float through = kLooksThrough * footprint;
  precise float near = kAgreement * footprint;
  precise float close = kCloseAgreement * footprint;
  return (behind > through ? kSupportOfLookingThrough : 0) + (apart <= near ? kSupportOfAgreement : 0) +
         (apart <= close ? kSupportOfAgreement : 0);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  float d = depth[pixel];
  int sum = p.is_first != 0 ? 0 : support[pixel];
  support[pixel] = d > 0.0 ? sum + support_of(x, y, d) : 0;
}
