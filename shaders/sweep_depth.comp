// NCC of the windows of a batch of items against one neighbor (the paper, section 2.1), in the form for GPUs: a work
// group sweeps one item, a block of the view on one plane. Each sample is warped once into shared memory; windows are
// summed along rows, then down columns. Windows of the axis model share no samples and are summed one by one.
// Twin: window_ncc in engine/depth/sweep_depth.cc. The form for software Vulkan: sweep_depth_lanes.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/project.glsl"
#include "lib/sample_bilinear.glsl"
#include "lib/ncc_from_sums.glsl"

layout(local_size_x_id = 3, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kAxisModel = 0;  // 1: the paper's axis-aligned windows; 0: windows on the plane
layout(constant_id = 2) const int kShift = 12;     // kSampleShift, one more for the largest windows
layout(constant_id = 3) const uint kGroupSize = 256;  // kBlockWidth * kBlockHeight
layout(constant_id = 4) const int kBlockWidth = 16;
layout(constant_id = 5) const int kBlockHeight = 16;

layout(push_constant) uniform Push { SweepParams p; };
layout(std430, binding = 0) readonly buffer Items { SweepItem items[]; };
layout(std430, binding = 1) readonly buffer Reference { uint reference_pixels[]; };
layout(std430, binding = 2) readonly buffer Windows { ReferenceWindow reference_windows[]; };
layout(std430, binding = 3) readonly buffer Neighbor { uint neighbor_pixels[]; };
layout(std430, binding = 4) writeonly buffer Ncc { float ncc_values[]; };

const int kRadius = kWindow / 2;
const int kPixels = kBlockWidth * kBlockHeight;
const int kColumns = kBlockWidth + kWindow - 1;  // of samples
const int kRows = kBlockHeight + kWindow - 1;

// What is summed over a window: the channels of b, b * b and a * b. Arrays of one quantity, so that threads side by
// side use different banks.
const int kQuantities = 5;
shared int samples[kQuantities][kColumns * kRows];
shared bool inside[kColumns * kRows];
shared int row_sums[kQuantities][kBlockWidth * kRows];

// Clamped: blocks reach over the image, where no pixel asks for a window.
ivec3 reference_sample(int x, int y) {
  int column = clamp(x, 0, p.width - 1);
  int row = clamp(y, 0, p.height - 1);
  return sample_pixel(reference_pixels[row * (p.width + 1) + column], kShift);
}

ivec3 neighbor_sample(int u, int v) {
  int stride = p.neighbor_width + 1;
  int texel = texel_index(u, v, stride);
  return sample_bilinear(neighbor_pixels[texel], neighbor_pixels[texel + 1], neighbor_pixels[texel + stride],
                         neighbor_pixels[texel + stride + 1], u, v, kShift);
}

float axis_window_ncc(int x, int y, float inverse_depth, ReferenceWindow window) {
  Projection center =
      project(p.warp, x, y, inverse_depth, p.neighbor_width, p.neighbor_height, kRadius * kPositionScale);
  if (!center.inside) return kNoNcc;
  WindowSums sums = no_sums();
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx)
      add_sample(sums, reference_sample(x + dx, y + dy),
                 neighbor_sample(center.u + dx * kPositionScale, center.v + dy * kPositionScale));
  return ncc_from_sums(window, sums, kWindow * kWindow);
}

void main() {
  int thread = int(gl_LocalInvocationID.x);
  int item_index = int(gl_WorkGroupID.x);
  SweepItem item = items[item_index];
  int column = thread % kBlockWidth;
  int row = thread / kBlockWidth;
  ReferenceWindow window = reference_windows[(item.y + row) * p.window_stride + item.x + column];
  int output_index = 4 * p.ncc_offset + item_index * kPixels + thread;
  if (kAxisModel != 0) {
    ncc_values[output_index] = axis_window_ncc(item.x + column, item.y + row, item.inverse_depth, window);
    return;
  }

  for (int i = thread; i < kColumns * kRows; i += kPixels) {
    int x = item.x - kRadius + i % kColumns;
    int y = item.y - kRadius + i / kColumns;
    Projection at = project(p.warp, x, y, item.inverse_depth, p.neighbor_width, p.neighbor_height, 0);
    ivec3 a = reference_sample(x, y);
    ivec3 b = neighbor_sample(at.u, at.v);
    samples[0][i] = b.x;
    samples[1][i] = b.y;
    samples[2][i] = b.z;
    samples[3][i] = product(b, b);
    samples[4][i] = product(a, b);
    inside[i] = at.inside;
  }
  barrier();
  for (int i = thread; i < kBlockWidth * kRows; i += kPixels) {
    int first = i / kBlockWidth * kColumns + i % kBlockWidth;
    for (int quantity = 0; quantity < kQuantities; ++quantity) {
      int sum = 0;
      for (int k = 0; k < kWindow; ++k) sum += samples[quantity][first + k];
      row_sums[quantity][i] = sum;
    }
  }
  barrier();
  int sums[kQuantities];
  for (int quantity = 0; quantity < kQuantities; ++quantity) {
    sums[quantity] = 0;
    for (int k = 0; k < kWindow; ++k) sums[quantity] += row_sums[quantity][(row + k) * kBlockWidth + column];
  }
  // A plane maps the window to a convex quadrilateral, so the corners decide for all of it.
  int corner = row * kColumns + column;
  bool sees = inside[corner] && inside[corner + kWindow - 1] &&
              inside[corner + (kWindow - 1) * kColumns] &&
              inside[corner + (kWindow - 1) * (kColumns + 1)];
  WindowSums window_sums = WindowSums(ivec3(sums[0], sums[1], sums[2]), sums[3], sums[4]);
  ncc_values[output_index] = sees ? ncc_from_sums(window, window_sums, kWindow * kWindow) : kNoNcc;
}
