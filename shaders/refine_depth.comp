// The second pass of the paper (section 4.1): NCC of each pixel's window against one neighbor on the planes of its own
// range, slot by slot. Twin: engine/depth/refine_depth.h for the ranges, window_ncc in sweep_depth.cc for the windows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/window.glsl"

layout(local_size_x_id = 3, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 3) const uint kGroupSize = 64;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  int slot = int(gl_GlobalInvocationID.z);
  if (x >= p.width || row >= p.row_count || slot >= p.plane_count) return;
  int y = p.row_begin + row;
  PlaneRange range = ranges[y * p.width + x];
  uint plane = range.first + uint(p.first_plane + slot);
  if (plane > range.last) return;
  ncc_values[p.ncc_offset + (slot * p.row_count + row) * p.width + x] = window_ncc(x, y, inverse_depths[plane]);
}
