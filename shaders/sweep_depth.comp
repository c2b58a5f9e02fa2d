// NCC of every window of a batch of rows and planes against one neighbor (the paper, section 2.1). An invocation takes a
// strip of kStripRows pixels in one column on one plane and carries the sums of the window down it: a row is added below
// and one taken off above, without barriers or arrays, which is what software Vulkan does fast.
// Twin: engine/depth/sweep_depth.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/window.glsl"

layout(local_size_x_id = 3, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 3) const uint kGroupSize = 64;
layout(constant_id = 4) const int kStripRows = 16;

bool tests_plane(int x, int y, uint plane) {
  PlaneRange range = ranges[y * p.width + x];
  return plane >= range.first && plane <= range.last;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int slot = int(gl_GlobalInvocationID.z);
  int row = int(gl_GlobalInvocationID.y) * kStripRows;
  if (x >= p.width || row >= p.row_count || slot >= p.plane_count) return;
  int row_end = min(row + kStripRows, p.row_count);
  uint plane = uint(p.first_plane + slot * p.plane_stride);

  int first = row_end;
  int last = row - 1;
  for (int i = row; i < row_end; ++i) {
    if (!tests_plane(x, p.row_begin + i, plane)) continue;
    first = min(first, i);
    last = i;
  }
  float inverse_depth = inverse_depths[plane];
  WindowSums sums = no_sums();
  for (int i = first; i <= last; ++i) {
    int y = p.row_begin + i;
    int output_index = p.ncc_offset + (slot * p.row_count + i) * p.width + x;
    if (kAxisModel != 0) {
      ncc_values[output_index] = axis_window_ncc(x, y, inverse_depth);
      continue;
    }
    if (i == first) {
      for (int dy = -kRadius; dy <= kRadius; ++dy) add_row(sums, x, y + dy, inverse_depth, 1);
    } else {
      add_row(sums, x, y + kRadius, inverse_depth, 1);
      add_row(sums, x, y - kRadius - 1, inverse_depth, -1);
    }
    ncc_values[output_index] =
        sees_window(x, y, inverse_depth) ? ncc_from_sums(sums, kWindow * kWindow) : kNoNcc;
  }
}
