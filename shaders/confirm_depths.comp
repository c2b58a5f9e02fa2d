// Adds what one other view's depth map says of each depth of a view: whether it sees the same surface there, looks
// through it, or sees something in front that is surer and that the view denies. Twin: engine/volume/confirm_depths.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { ConfirmDepthsParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer OtherDepth { float other_depth[]; };
// Read where denials are looked for.
layout(std430, binding = 2) readonly buffer Certainty { float certainty[]; };
layout(std430, binding = 3) readonly buffer OtherCertainty { float other_certainty[]; };
layout(std430, binding = 4) buffer Support { int support[]; };

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

// A depth of a view in another: position in pixels and depth, which say nothing unless z > 0.
struct SeenPoint {
  float u;
  float v;
  float z;
};

SeenPoint see_from(PlaneWarp warp, float x, float y, float d) {
  precise float rx = warp.rotation[0] * x + (warp.rotation[1] * y + warp.rotation[2]);
  precise float ry = warp.rotation[3] * x + (warp.rotation[4] * y + warp.rotation[5]);
  precise float rz = warp.rotation[6] * x + (warp.rotation[7] * y + warp.rotation[8]);
  precise float z = rz * d + warp.offset[2];
  precise float least = kMinDepthRatio * d;
  bool before = z > least;
  float inverse_z = reciprocal(before ? z : 1.0);
  precise float u = (rx * d + warp.offset[0]) * inverse_z;
  precise float v = (ry * d + warp.offset[1]) * inverse_z;
  return SeenPoint(u, v, before ? z : 0.0);
}

bool is_in_a_cell(SeenPoint point, int width, int height) {
  return point.z > 0.0 && point.u >= 0.0 && point.v >= 0.0 && point.u < float(width - 1) &&
         point.v < float(height - 1);
}

bool looks_through(int x, int y, float seen_depth) {
  SeenPoint point = see_from(p.back, float(x), float(y), seen_depth);
  if (!is_in_a_cell(point, p.width, p.height)) return false;
  precise float limit = point.z + kLooksThrough * (p.footprint * point.z);
  int corner = int(point.v) * p.width + int(point.u);
  float d0 = depth[corner];
  float d1 = depth[corner + 1];
  float d2 = depth[corner + p.width];
  float d3 = depth[corner + p.width + 1];
  bool any = d0 > 0.0 || d1 > 0.0 || d2 > 0.0 || d3 > 0.0;
  return any && (d0 <= 0.0 || d0 > limit) && (d1 <= 0.0 || d1 > limit) && (d2 <= 0.0 || d2 > limit) &&
         (d3 <= 0.0 || d3 > limit);
}

int support_of(SeenPoint point, int pixel) {
  if (!is_in_a_cell(point, p.other_width, p.other_height)) return 0;
  float seen = surface_depth(point.u, point.v);
  if (!(seen > 0.0)) return 0;
  precise float footprint = p.other_footprint * point.z;
  precise float behind = seen - point.z;
  float apart = abs(behind);
  precise float through = kLooksThrough * footprint;
  precise float near = kAgreement * footprint;
  precise float close = kCloseAgreement * footprint;
  int sum = (behind > through ? kSupportOfLookingThrough : 0) + (apart <= near ? kSupportOfAgreement : 0) +
            (apart <= close ? kSupportOfAgreement : 0);
  if ((p.steps & kFindsDenials) != 0u && -behind > through) {
    precise float u = point.u + 0.5;
    precise float v = point.v + 0.5;
    int x = int(u);
    int y = int(v);
    int other_pixel = y * p.other_width + x;
    float front = other_depth[other_pixel];
    precise float before = point.z - front;
    if (front > 0.0 && before > through && other_certainty[other_pixel] > certainty[pixel] &&
        looks_through(x, y, front))
      sum += kSupportOfDenial;
  }
  return sum;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  float d = depth[pixel];
  int sum = (p.steps & kFirstOfViews) != 0u ? 0 : support[pixel];
  support[pixel] = sum + (d > 0.0 ? support_of(see_from(p.warp, float(x), float(y), d), pixel) : 0);
}
