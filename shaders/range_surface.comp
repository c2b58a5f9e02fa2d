// The triangles of one depth map (the paper, section 2.2). Twin: engine/volume/range_surface.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/cell.glsl"
#include "lib/plane_edges.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { RangeSurfaceParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Normals { uint normals[]; };  // one word where agreement is 0
layout(std430, binding = 2) writeonly buffer Cells { uint cells[]; };

SurfacePixel pixel_at(int x, int y) {
  int pixel = y * p.width + x;
  return SurfacePixel(float(x), float(y), depth[pixel], p.agreement > 0.0 ? normals[pixel] : 0u);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  uint cell = 0u;
  if (x < p.width - 1 && y < p.height - 1) {
    SurfacePixel p0 = pixel_at(x, y);
    SurfacePixel p1 = pixel_at(x + 1, y);
    SurfacePixel p2 = pixel_at(x, y + 1);
    SurfacePixel p3 = pixel_at(x + 1, y + 1);
    bool split_03 = is_split_03(p0.depth, p1.depth, p2.depth, p3.depth);
    bool diagonal = split_03 ? joined_on_planes(p0, p3, kDiagonal, p) : joined_on_planes(p1, p2, kDiagonal, p);
    cell = cell_bits(split_03, joined_on_planes(p0, p1, 1.0, p), joined_on_planes(p0, p2, 1.0, p),
                     joined_on_planes(p1, p3, 1.0, p), joined_on_planes(p2, p3, 1.0, p), diagonal);
  }
  cells[y * p.width + x] = cell;
}
