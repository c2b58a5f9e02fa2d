// The same windows as sweep_depth.comp, in the form for software Vulkan, which runs invocations as the lanes of vector
// instructions: there memory is read word by word unless it comes as texels, barriers cost dear, arithmetic is cheap.
// An invocation sweeps one item: it walks down the rows of its block with the partial sums of all windows that the row
// touches, so that each sample is warped once. Plane windows only. Twin: window_ncc in engine/depth/sweep_depth.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"
#include "lib/project.glsl"
#include "lib/sample_bilinear.glsl"
#define NCC_IN_DOUBLES
#include "lib/ncc_from_sums.glsl"

layout(local_size_x_id = 3, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 2) const int kShift = 12;  // kSampleShift, one more for the largest windows
layout(constant_id = 3) const uint kGroupSize = 16;
layout(constant_id = 4) const int kBlockWidth = 8;
layout(constant_id = 5) const int kBlockHeight = 8;

layout(push_constant) uniform Push { SweepParams p; };
layout(binding = 0) uniform usamplerBuffer items;              // SweepItem
layout(binding = 1) uniform usamplerBuffer reference_pixels;   // four of a row
layout(binding = 2) uniform usamplerBuffer reference_windows;  // ReferenceWindow
layout(binding = 3) uniform usamplerBuffer neighbor_quads;     // the four texels of a sample
layout(std430, binding = 4) writeonly buffer Ncc { vec4 ncc_values[]; };

const int kRadius = kWindow / 2;
const int kSamples = kBlockWidth + kWindow - 1;  // in a row
const int kPartial = kWindow - 1;                 // rows of windows that are begun and not done

WindowSums add(WindowSums x, WindowSums y) { return WindowSums(x.b + y.b, x.bb + y.bb, x.ab + y.ab); }
WindowSums subtract(WindowSums x, WindowSums y) { return WindowSums(x.b - y.b, x.bb - y.bb, x.ab - y.ab); }

void main() {
  // Invocations beyond the last item repeat it: a return would mask all that follows. Parameters are read here because
  // under a mask, and so in a loop, a read takes each lane by itself.
  int item_index = min(int(gl_GlobalInvocationID.x), p.item_count - 1);
  uvec4 words = texelFetch(items, item_index);
  SweepItem item = SweepItem(int(words.x), int(words.y), int(words.z), uintBitsToFloat(words.w));
  PlaneWarp warp = p.warp;
  int neighbor_width = p.neighbor_width;
  int neighbor_height = p.neighbor_height;
  int reference_stride = p.reference_stride;
  int window_stride = p.window_stride;
  int output_index = p.ncc_offset + item_index * (kBlockWidth * kBlockHeight / 4);

  WindowSums partial[kPartial * kBlockWidth];  // of the windows whose last row comes next, next but one, ...
  uint seen[kPartial];                     // columns of which a row shows both ends, of the rows before
  [[unroll]] for (int i = 0; i < kPartial * kBlockWidth; ++i) partial[i] = no_sums();
  [[unroll]] for (int i = 0; i < kPartial; ++i) seen[i] = 0u;

  for (int row = 0; row < kBlockHeight + kWindow - 1; ++row) {
    int y = item.y - kRadius + row;
    WindowSums samples[kSamples];
    uint inside = 0u;
    [[unroll]] for (int i = 0; i < kSamples; ++i) {
      Projection at = project(warp, item.x - kRadius + i, y, item.inverse_depth, neighbor_width, neighbor_height, 0);
      inside |= at.inside ? 1u << i : 0u;
      uvec4 quad = texelFetch(neighbor_quads, texel_index(at.u, at.v, neighbor_width));
      ivec3 b = sample_bilinear(quad.x, quad.y, quad.z, quad.w, at.u, at.v, kShift);
      samples[i] = WindowSums(b, product(b, b), 0);
    }
    [[unroll]] for (int i = 0; i < kSamples; i += 4) {
      uvec4 pixels = texelFetch(reference_pixels, (item.y + row) * reference_stride + (item.x + i) / 4);
      [[unroll]] for (int k = 0; k < 4; ++k) {
        if (i + k >= kSamples) break;
        ivec3 a = sample_pixel(pixels[k], kShift);
        samples[i + k].ab = product(a, samples[i + k].b);
      }
    }
    uint ends = inside & (inside >> (kWindow - 1));
    uint seen_windows = ends & seen[0];
    [[unroll]] for (int k = 1; k < kPartial; ++k) seen[k - 1] = seen[k];
    seen[kPartial - 1] = ends;

    WindowSums sum = samples[0];
    [[unroll]] for (int i = 1; i < kWindow; ++i) sum = add(sum, samples[i]);
    WindowSums done[kBlockWidth];
    [[unroll]] for (int x = 0; x < kBlockWidth; ++x) {
      done[x] = add(partial[x], sum);
      [[unroll]] for (int k = 1; k < kPartial; ++k)
        partial[(k - 1) * kBlockWidth + x] = add(partial[k * kBlockWidth + x], sum);
      partial[(kPartial - 1) * kBlockWidth + x] = sum;
      if (x + 1 < kBlockWidth) sum = subtract(add(sum, samples[x + kWindow]), samples[x]);
    }
    if (row >= kWindow - 1) {
      int window_y = item.y + row - (kWindow - 1);
      float ncc[kBlockWidth];
      [[unroll]] for (int x = 0; x < kBlockWidth; ++x) {
        uvec4 a = texelFetch(reference_windows, window_y * window_stride + item.x + x);
        bool sees = (seen_windows & (1u << x)) != 0u;
        ReferenceWindow window = ReferenceWindow(int[3](int(a.x), int(a.y), int(a.z)), uintBitsToFloat(a.w));
        float value = ncc_from_sums(window, done[x], kWindow * kWindow);
        ncc[x] = sees ? value : kNoNcc;
      }
      int index = output_index + (row - (kWindow - 1)) * (kBlockWidth / 4);
      [[unroll]] for (int x = 0; x < kBlockWidth; x += 4)
        ncc_values[index + x / 4] = vec4(ncc[x], ncc[x + 1], ncc[x + 2], ncc[x + 3]);
    }
  }
}
