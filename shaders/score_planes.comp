// NCC of the support of each trial, on its tilted plane, against one neighbor, and its vote (the paper, section 2.1 and
// appendix A, with windows that lie on the surface). Trials that can't win any more are dropped.
// Twin: engine/depth/score_planes.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/place_window.glsl"
#include "lib/plane_moves.glsl"
#include "lib/sample_bilinear.glsl"
#include "lib/ncc_from_sums.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kShift = 12;  // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { ScorePlanesParams p; };
layout(std430, binding = 0) readonly buffer Reference { uint reference_pixels[]; };
layout(std430, binding = 1) readonly buffer Windows { SupportWindow support_windows[]; };
layout(std430, binding = 2) readonly buffer Neighbor { uint neighbor_pixels[]; };
layout(std430, binding = 3) readonly buffer Best { PixelPlane best[]; };
layout(std430, binding = 4) buffer Trials { PlaneTrial trials[]; };

const int kRadius = kWindow / 2;

void main() {
  int pixel = int(gl_GlobalInvocationID.x);
  if (pixel >= p.width * p.height) return;
  PlaneTrial trial = trials[pixel];
  // A loop of one round: software Vulkan skips a loop that no lane of a vector enters, but not a condition.
  for (int once = trial.inverse_depth != 0.0 ? 0 : 1; once < 1; ++once) {
    int x = pixel % p.width;
    int y = pixel / p.width;
    WindowPlacement at = place_window(p.warp, x, y, trial.inverse_depth, trial.slope_x, trial.slope_y, kRadius,
                                      p.neighbor_width, p.neighbor_height);
    int neighbor_stride = p.neighbor_width + 1;
    SupportWindow support = support_windows[pixel];
    uint middle = reference_pixels[y * (p.width + 1) + x];
    WindowSums sums = no_sums();
    int samples = at.seen ? kWindow * kWindow : 0;
    for (int i = 0; i < samples; ++i) {
      int dx = i % kWindow - kRadius;
      int dy = i / kWindow - kRadius;
      ivec2 position = place_sample(at.center, at.step_x, at.step_y, dx, dy);
      int texel = texel_index(position.x, position.y, neighbor_stride);
      ivec3 b = sample_bilinear(neighbor_pixels[texel], neighbor_pixels[texel + 1],
                                neighbor_pixels[texel + neighbor_stride],
                                neighbor_pixels[texel + neighbor_stride + 1], position.x, position.y, kShift);
      uint pixel = reference_pixels[(y + dy) * (p.width + 1) + x + dx];
      bool belongs = largest_difference(pixel, middle) <= support.max_difference;
      add_sample(sums, sample_pixel(pixel, kShift), belongs ? b : ivec3(0));
    }
    ReferenceWindow window = ReferenceWindow(support.sum, support.inverse_deviation);
    float ncc = at.seen ? ncc_from_sums(window, sums, support.samples) : kNoNcc;
    if (ncc > p.threshold) {
      precise float sum = trial.ncc_sum + ncc;
      trial.ncc_sum = sum;
      ++trial.votes;
    }
    bool stays = can_win(trial.ncc_sum, trial.votes, p.left, best[pixel].confidence, p.min_votes, p.threshold,
                         p.confidence_scale);
    if (!stays) trial = kNoTrial;
    trials[pixel] = trial;
  }
}
