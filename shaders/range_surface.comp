// The triangles of one depth map (the paper, section 2.2). Twin: engine/volume/range_surface.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/cell.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { RangeSurfaceParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) writeonly buffer Cells { uint cells[]; };

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  uint cell = 0u;
  if (x < p.width - 1 && y < p.height - 1)
    cell = cell_triangles(depth[pixel], depth[pixel + 1], depth[pixel + p.width], depth[pixel + p.width + 1],
                          p.max_step);
  cells[pixel] = cell;
}
