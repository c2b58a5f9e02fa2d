// The plane with which every pixel begins, and where its planes may cross its ray (beyond the paper: windows that lie
// on the surface): fitted to the depths of the first pass around it, or beyond the bounds.
// Twins: engine/depth/first_planes.cc, engine/depth/fit_planes.cc, and inverse_depth_ranges in
// engine/depth/plane_moves.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(push_constant) uniform Push { FirstPlanesParams p; };
layout(std430, binding = 0) readonly buffer Votes { PixelVote votes[]; };
layout(std430, binding = 1) readonly buffer PlaneRanges { PlaneRange plane_ranges[]; };
layout(std430, binding = 2) readonly buffer InverseDepths { float inverse_depths[]; };  // of the planes
layout(std430, binding = 3) readonly buffer Outside { OutsidePlane outside[]; };
layout(std430, binding = 4) writeonly buffer Ranges { InverseDepthRange ranges[]; };
layout(std430, binding = 5) writeonly buffer Planes { PixelPlane planes[]; };

const int kReach = 3;        // pixels on each side
const int kLeastDepths = 6;  // for slopes

// Functions of their own, because `precise` in loops makes glslang 12 follow assignments without end.
float add(float x, float y) {
  precise float sum = x + y;
  return sum;
}

float add_product(float sum, int factor, float x) {
  precise float product = float(factor) * x;
  precise float result = sum + product;
  return result;
}

bool has_outside() { return p.outside_width > 0; }

OutsidePlane outside_of(int x, int y) {
  int column = min(x >> p.outside_halvings, p.outside_width - 1);
  int row = min(y >> p.outside_halvings, p.outside_height - 1);
  return outside[row * p.outside_width + column];
}

bool prefers_outside(int x, int y, PixelVote vote) {
  if (!has_outside()) return false;
  OutsidePlane plane = outside_of(x, y);
  return plane.inverse_depth > 0.0 && plane.correlation > vote.correlation;
}

// The plane of the first pass that a pixel has, -1 = none in the bounds.
int plane_of(int x, int y) {
  PixelVote vote = votes[y * p.width + x];
  return prefers_outside(x, y, vote) ? -1 : vote.plane;
}

// Moments of the offsets of pixels and of their inverse depths w against that of the center.
struct Moments {
  int n;
  int x, y, xx, xy, yy;
  float w, xw, yw;
};

PixelPlane begin_with(float inverse_depth, float slope_x, float slope_y) {
  return PixelPlane(inverse_depth, slope_x, slope_y, 0.0, 0.0, 1);
}

PixelPlane fitted(Moments m, float inverse_depth) {
  // The normal equations with the mean taken off, times n: [a b; b c] * slopes = (d, e).
  int a = m.n * m.xx - m.x * m.x;
  int b = m.n * m.xy - m.x * m.y;
  int c = m.n * m.yy - m.y * m.y;
  int determinant = a * c - b * b;
  if (m.n < kLeastDepths || determinant <= 0) return begin_with(inverse_depth, 0.0, 0.0);
  precise float d = float(m.n) * m.xw - float(m.x) * m.w;
  precise float e = float(m.n) * m.yw - float(m.y) * m.w;
  float scale = reciprocal(float(determinant));
  precise float slope_x = (float(c) * d - float(b) * e) * scale;
  precise float slope_y = (float(a) * e - float(b) * d) * scale;
  precise float mean = (m.w - (slope_x * float(m.x) + slope_y * float(m.y))) * reciprocal(float(m.n));
  precise float at_center = inverse_depth + mean;
  return begin_with(at_center, slope_x, slope_y);
}

PixelPlane fit_plane(int x, int y, int plane) {
  float here = inverse_depths[plane];
  Moments m = Moments(0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0);
  for (int dy = max(-kReach, -y); dy <= min(kReach, p.height - 1 - y); ++dy) {
    for (int dx = max(-kReach, -x); dx <= min(kReach, p.width - 1 - x); ++dx) {
      int other = plane_of(x + dx, y + dy);
      if (other < 0) continue;
      float difference = add(inverse_depths[other], -here);
      if (difference < -p.limit || difference > p.limit) continue;
      ++m.n;
      m.x += dx;
      m.y += dy;
      m.xx += dx * dx;
      m.xy += dx * dy;
      m.yy += dy * dy;
      m.w = add(m.w, difference);
      m.xw = add_product(m.xw, dx, difference);
      m.yw = add_product(m.yw, dy, difference);
    }
  }
  return fitted(m, here);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  PlaneRange tested = plane_ranges[pixel];
  InverseDepthRange range = InverseDepthRange(1.0, 0.0);
  if (tested.first <= tested.last)
    range = InverseDepthRange(has_outside() ? 0.0 : inverse_depths[tested.last], inverse_depths[tested.first]);
  ranges[pixel] = range;
  PixelPlane first = PixelPlane(0.0, 0.0, 0.0, 0.0, 0.0, 0);
  PixelVote vote = votes[pixel];
  if (prefers_outside(x, y, vote)) first = begin_with(outside_of(x, y).inverse_depth, 0.0, 0.0);
  else if (vote.plane >= 0) first = fit_plane(x, y, vote.plane);
  planes[pixel] = first;
}
