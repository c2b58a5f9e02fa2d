// The weights of a range surface's vertices: confidence, grazing angle, distance from borders (the paper, section 2.2);
// beside each the cosine of distances.
// Twin: engine/volume/weigh_surface.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { WeighSurfaceParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Confidence { float confidence[]; };
layout(std430, binding = 2) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 3) writeonly buffer Weights { uint weights[]; };

const uint kBothTriangles = kCellFirstTriangle | kCellSecondTriangle;

bool contains(int x, int y) { return x >= 0 && y >= 0 && x < p.width && y < p.height; }
uint cell_at(int x, int y) { return contains(x, y) ? cells[y * p.width + x] : 0u; }
float depth_at(int x, int y) { return contains(x, y) ? depth[y * p.width + x] : 0.0; }

bool has_corner(int x, int y, uint when_12, uint when_03) {
  uint cell = cell_at(x, y);
  return (cell & ((cell & kCellSplitAlong03) != 0u ? when_03 : when_12)) != 0u;
}

bool on_surface(int x, int y) {
  return has_corner(x, y, kCellFirstTriangle, kBothTriangles) ||
         has_corner(x - 1, y, kBothTriangles, kCellFirstTriangle) ||
         has_corner(x, y - 1, kBothTriangles, kCellSecondTriangle) ||
         has_corner(x - 1, y - 1, kCellSecondTriangle, kBothTriangles);
}

int border_distance(int x, int y) {
  int nearest = p.feather;
  for (int dy = -p.feather; dy < p.feather; ++dy) {
    for (int dx = -p.feather; dx < p.feather; ++dx) {
      if ((cell_at(x + dx, y + dy) & kBothTriangles) == kBothTriangles) continue;
      nearest = min(nearest, max(dx >= 0 ? dx : -dx - 1, dy >= 0 ? dy : -dy - 1));
    }
  }
  return nearest;
}

float slope(float before, float here, float after) {
  bool has_before = joined(before, here, p.max_step, 1.0);
  bool has_after = joined(here, after, p.max_step, 1.0);
  float from = has_before ? before : here;
  float to = has_after ? after : here;
  precise float result = (to - from) * (has_before && has_after ? 0.5 : 1.0);
  return result;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  if (!on_surface(x, y)) {
    weights[pixel] = 0u;
    return;
  }
  float d = depth[pixel];
  precise float gx = p.focal_x * slope(depth_at(x - 1, y), d, depth_at(x + 1, y));
  precise float gy = p.focal_y * slope(depth_at(x, y - 1), d, depth_at(x, y + 1));
  precise float rx = (float(x) - p.principal_x) * reciprocal(p.focal_x);
  precise float ry = (float(y) - p.principal_y) * reciprocal(p.focal_y);
  precise float nz = d + (gx * rx + gy * ry);
  precise float normal_squared = gx * gx + (gy * gy + nz * nz);
  precise float ray_squared = rx * rx + (ry * ry + 1.0);
  precise float cosine = (d * reciprocal_sqrt(normal_squared)) * reciprocal_sqrt(ray_squared);
  precise float ramp = float(border_distance(x, y) + 1) * reciprocal(float(p.feather + 1));
  float confidence_factor = (p.factors & kWeighConfidence) != 0u ? confidence[pixel] : 1.0;
  float slant_factor = (p.factors & kWeighSlant) != 0u ? cosine : 1.0;
  precise float border_factor = (p.factors & kWeighBorder) != 0u ? ramp * ramp : 1.0;
  precise float weight = ((confidence_factor * slant_factor) * border_factor) * float(kWeightScale) + 0.5;
  float distance_factor = (p.factors & kDistanceAlongNormal) != 0u ? cosine : 1.0;
  precise float scaled_cosine = distance_factor * float(kCosineScale) + 0.5;
  int cosine_bits = clamp(int(scaled_cosine), 1, kCosineScale) << kWeightBits;
  weights[pixel] = uint(clamp(int(weight), 1, kWeightScale) + cosine_bits);
}
