// Windows of the reference view and of one neighbor, for sweep_depth and refine_depth.
// Twin: window_ncc in engine/depth/sweep_depth.cc.
#include "lib/project.glsl"
#include "lib/sample_bilinear.glsl"
#include "lib/ncc_from_sums.glsl"

layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kAxisModel = 0;  // 1: the paper's axis-aligned windows; 0: windows on the plane
layout(constant_id = 2) const int kShift = 12;     // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { SweepParams p; };
layout(std430, binding = 0) readonly buffer Reference { uint reference_pixels[]; };
layout(std430, binding = 1) readonly buffer Neighbor { uint neighbor_pixels[]; };
layout(std430, binding = 2) readonly buffer Planes { float inverse_depths[]; };
layout(std430, binding = 3) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 4) writeonly buffer Ncc { float ncc_values[]; };

const int kRadius = kWindow / 2;

// Clamped: sums over strips run past windows that no pixel asks for.
ivec3 reference_sample(int x, int y) {
  int column = clamp(x, 0, p.width - 1);
  int row = clamp(y, 0, p.height - 1);
  return sample_pixel(reference_pixels[row * (p.width + 1) + column], kShift);
}

ivec3 neighbor_sample(int u, int v) {
  int stride = p.neighbor_width + 1;
  int texel = (v >> kPositionBits) * stride + (u >> kPositionBits);
  return sample_bilinear(neighbor_pixels[texel], neighbor_pixels[texel + 1], neighbor_pixels[texel + stride],
                         neighbor_pixels[texel + stride + 1], u, v, kShift);
}

Projection project_pixel(int x, int y, float inverse_depth) {
  return project(p.warp, x, y, inverse_depth, p.neighbor_width, p.neighbor_height);
}

// True if the neighbor sees the whole window on the plane: it does if it sees the corners.
bool sees_window(int x, int y, float inverse_depth) {
  return project_pixel(x - kRadius, y - kRadius, inverse_depth).inside &&
         project_pixel(x + kRadius, y - kRadius, inverse_depth).inside &&
         project_pixel(x - kRadius, y + kRadius, inverse_depth).inside &&
         project_pixel(x + kRadius, y + kRadius, inverse_depth).inside;
}

// Adds (sign 1) or takes off (sign -1) the samples of one row of a window on the plane.
void add_row(inout WindowSums sums, int x, int y, float inverse_depth, int sign) {
  WindowSums row = no_sums();
  for (int dx = -kRadius; dx <= kRadius; ++dx) {
    Projection at = project_pixel(x + dx, y, inverse_depth);
    add_sample(row, reference_sample(x + dx, y), neighbor_sample(at.u, at.v));
  }
  sums.a += sign * row.a;
  sums.b += sign * row.b;
  sums.aa += sign * row.aa;
  sums.bb += sign * row.bb;
  sums.ab += sign * row.ab;
}

float axis_window_ncc(int x, int y, float inverse_depth) {
  Projection center = project_pixel(x, y, inverse_depth);
  int reach = kRadius * kPositionScale;
  bool inside = center.inside && center.u >= reach && center.v >= reach &&
                center.u + reach <= (p.neighbor_width - 1) * kPositionScale &&
                center.v + reach <= (p.neighbor_height - 1) * kPositionScale;
  if (!inside) return kNoNcc;
  WindowSums sums = no_sums();
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx)
      add_sample(sums, reference_sample(x + dx, y + dy),
                 neighbor_sample(center.u + dx * kPositionScale, center.v + dy * kPositionScale));
  return ncc_from_sums(sums, kWindow * kWindow);
}

float plane_window_ncc(int x, int y, float inverse_depth) {
  if (!sees_window(x, y, inverse_depth)) return kNoNcc;
  WindowSums sums = no_sums();
  for (int dy = -kRadius; dy <= kRadius; ++dy) add_row(sums, x, y + dy, inverse_depth, 1);
  return ncc_from_sums(sums, kWindow * kWindow);
}

float window_ncc(int x, int y, float inverse_depth) {
  if (kAxisModel != 0) return axis_window_ncc(x, y, inverse_depth);
  return plane_window_ncc(x, y, inverse_depth);
}
