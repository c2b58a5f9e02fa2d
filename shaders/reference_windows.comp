// What NCC needs of the windows of a reference view (the paper, appendix A). Twin: engine/depth/reference_windows.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/reference_windows.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kShift = 12;  // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { ReferenceWindowsParams p; };
layout(std430, binding = 0) readonly buffer Image { uint pixels[]; };
layout(std430, binding = 1) writeonly buffer Windows { ReferenceWindow windows[]; };

#include "lib/pixel_tile.glsl"

void main() {
  load_tile(ivec2(gl_WorkGroupID.xy) * kSide, p.width, p.height);
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.columns || y >= p.rows) return;
  ReferenceWindow window = ReferenceWindow(int[3](0, 0, 0), 0.0);
  if (has_window(x, y, p.width, p.height)) {
    ReferenceSums sums = ReferenceSums(ivec3(0), 0);
    int place = own_place();
    for (int dy = -kRadius; dy <= kRadius; ++dy)
      for (int dx = -kRadius; dx <= kRadius; ++dx)
        add_sample(sums, sample_pixel(tile[place + dy * kTile + dx], kShift));
    window = window_from_sums(sums, kWindow * kWindow);
  }
  windows[y * p.columns + x] = window;
}
