// Marks the voxel blocks within the truncation of a range surface. Twin: engine/volume/collect_blocks.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { CollectParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 2) buffer Bits { uint bits[]; };

// First and last block that a point and its margin touch along one axis, cut to the grid.
ivec2 block_span(float position, int blocks) {
  float size = float(blocks);
  precise float low = clamp(position - p.margin, -1.0, size);
  precise float high = clamp(position + p.margin, -1.0, size);
  return ivec2(max(int(floor(low)), 0), min(int(floor(high)), blocks - 1));
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  int pixel = y * p.width + x;
  if (weights[pixel] == 0u) return;
  float fx = float(x);
  float fy = float(y);
  precise float ray_x = p.ray_from_pixel[0] * fx + (p.ray_from_pixel[1] * fy + p.ray_from_pixel[2]);
  precise float ray_y = p.ray_from_pixel[3] * fx + (p.ray_from_pixel[4] * fy + p.ray_from_pixel[5]);
  precise float ray_z = p.ray_from_pixel[6] * fx + (p.ray_from_pixel[7] * fy + p.ray_from_pixel[8]);
  for (int i = -p.steps; i <= p.steps; ++i) {
    precise float d = depth[pixel] + float(i) * p.depth_step;
    precise float px = p.origin[0] + ray_x * d;
    precise float py = p.origin[1] + ray_y * d;
    precise float pz = p.origin[2] + ray_z * d;
    ivec2 span_x = block_span(px, p.blocks[0]);
    ivec2 span_y = block_span(py, p.blocks[1]);
    ivec2 span_z = block_span(pz, p.blocks[2]);
    for (int bz = span_z.x; bz <= span_z.y; ++bz) {
      for (int by = span_y.x; by <= span_y.y; ++by) {
        for (int bx = span_x.x; bx <= span_x.y; ++bx) {
          uint index = uint(bx + p.blocks[0] * (by + p.blocks[1] * bz));
          uint bit = 1u << (index % 32u);
          if ((bits[index / 32u] & bit) == 0u) atomicOr(bits[index / 32u], bit);
        }
      }
    }
  }
}
