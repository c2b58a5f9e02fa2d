// The part of each window of a reference view that looks like its center (beyond the paper: windows end where the
// surface does). Twin: engine/depth/support_windows.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/reference_windows.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kShift = 12;  // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { SupportWindowsParams p; };
layout(std430, binding = 0) readonly buffer Image { uint pixels[]; };
layout(std430, binding = 1) writeonly buffer Windows { SupportWindow windows[]; };

#include "lib/pixel_tile.glsl"

const int kLeastSamples = (kWindow * kWindow * 9 + 24) / 25;  // 9 of 25

// Pixels of the window that differ from its center by at most this much.
int count_samples(int place, int max_difference) {
  uint center = tile[place];
  int count = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx)
      if (largest_difference(tile[place + dy * kTile + dx], center) <= max_difference) ++count;
  return count;
}

// The least difference, above the tolerance, at which a support is large enough: that of its last sample.
int least_difference(int place) {
  int low = p.tolerance + 1;
  int high = 255;
  while (low < high) {
    int middle = (low + high) / 2;
    if (count_samples(place, middle) >= kLeastSamples) high = middle;
    else low = middle + 1;
  }
  return low;
}

void main() {
  load_tile(ivec2(gl_WorkGroupID.xy) * kSide, p.width, p.height);
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.height) return;
  SupportWindow support = SupportWindow(int[3](0, 0, 0), 0.0, 0, 0);
  if (has_window(x, y, p.width, p.height)) {
    int place = own_place();
    uint center = tile[place];
    int most = count_samples(place, p.tolerance) >= kLeastSamples ? p.tolerance : least_difference(place);
    ReferenceSums sums = ReferenceSums(ivec3(0), 0);
    int samples = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        uint pixel = tile[place + dy * kTile + dx];
        if (largest_difference(pixel, center) > most) continue;
        add_sample(sums, sample_pixel(pixel, kShift));
        ++samples;
      }
    }
    ReferenceWindow window = window_from_sums(sums, samples);
    support = SupportWindow(window.sum, window.inverse_deviation, samples, most);
  }
  windows[y * p.width + x] = support;
}
