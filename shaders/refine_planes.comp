// A round of planes that every pixel tries (beyond the paper: windows that lie on the surface), in the form for GPUs:
// an invocation goes through the moves of the round, and for each move through the neighbors, until a trial can't win
// any more. As one loop over windows, not two nested ones, so that invocations that run in lockstep go on with their
// next window as soon as they have done one. The pixels of the reference that a work group sees lie in shared memory.
// Twin: engine/depth/refine_planes.cc. The form for software Vulkan: refine_planes_lanes.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/place_window.glsl"
#include "lib/plane_moves.glsl"
#include "lib/sample_bilinear.glsl"
#include "lib/ncc_from_sums.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kShift = 12;  // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { RefinePlanesParams p; };
layout(std430, binding = 0) readonly buffer Moves { PlaneMove moves[]; };
layout(std430, binding = 1) readonly buffer Neighbors { PlaneNeighbor neighbors[]; };
layout(std430, binding = 2) readonly buffer Ranges { InverseDepthRange ranges[]; };
layout(std430, binding = 3) readonly buffer Windows { SupportWindow support_windows[]; };
layout(std430, binding = 4) readonly buffer Images { uint pixels[]; };      // the reference, then its neighbors
layout(std430, binding = 5) readonly buffer Last { PixelPlane last[]; };    // planes of the last round
layout(std430, binding = 6) buffer Best { PixelPlane best[]; };             // and of this one

#include "lib/pixel_tile.glsl"

// The sums of a window that the neighbor sees whole. middle: its place in the tile.
WindowSums sum_window(WindowPlacement at, PlaneNeighbor neighbor, int middle, int max_difference) {
  int stride = neighbor.width + 1;
  uint center = tile[middle];
  WindowSums sums = no_sums();
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      uint pixel = tile[middle + dy * kTile + dx];
      ivec2 position = place_sample(at.center, at.step_x, at.step_y, dx, dy);
      int texel = neighbor.first_texel + texel_index(position.x, position.y, stride);
      ivec3 b = sample_bilinear(pixels[texel], pixels[texel + 1], pixels[texel + stride], pixels[texel + stride + 1],
                                position.x, position.y, kShift);
      bool belongs = largest_difference(pixel, center) <= max_difference;
      add_sample(sums, sample_pixel(pixel, kShift), belongs ? b : ivec3(0));
    }
  }
  return sums;
}

// A function of its own, because `precise` in the loop of main makes glslang 12 follow assignments without end.
float add(float x, float y) {
  precise float sum = x + y;
  return sum;
}

void main() {
  load_tile(ivec2(gl_WorkGroupID.xy) * kSide + ivec2(0, p.row_begin), p.width, p.height);
  int x = int(gl_GlobalInvocationID.x);
  int y = p.row_begin + int(gl_GlobalInvocationID.y);
  if (x >= p.width || y >= p.row_end) return;
  int pixel = y * p.width + x;
  int middle = own_place();
  const PixelPlane none = PixelPlane(0.0, 0.0, 0.0, 0.0, 0.0, 0);
  PixelPlane plane = none;
  if (p.move_begin > 0) {
    plane = best[pixel];
  } else if (p.is_first == 0) {
    plane = last[pixel];
    plane.taken_by = 0;
  }
  InverseDepthRange range = ranges[pixel];
  SupportWindow support = support_windows[pixel];
  ReferenceWindow window = ReferenceWindow(support.sum, support.inverse_deviation);
  int move_index = range.farthest > range.nearest ? p.move_end : p.move_begin;
  PlaneTrial trial = kNoTrial;
  int neighbor = 0;
  bool trying = false;
  while (true) {
    while (!trying && move_index < p.move_end) {
      PlaneMove move = moves[move_index];
      ++move_index;
      int other_x = x + move.offset_x;
      int other_y = y + move.offset_y;
      PixelPlane other = none;
      if (other_x >= 0 && other_y >= 0 && other_x < p.width && other_y < p.height)
        other = last[other_y * p.width + other_x];
      if (p.is_first != 0) trial = PlaneTrial(other.inverse_depth, other.slope_x, other.slope_y, 0.0, 0);
      else trial = move_plane(move, plane, other);
      trying = trial.inverse_depth != 0.0 && may_take(trial, range, p.max_tilt);
      neighbor = 0;
    }
    if (!trying) break;
    PlaneNeighbor image = neighbors[neighbor];
    ++neighbor;
    WindowPlacement at = place_window(image.warp, x, y, trial.inverse_depth, trial.slope_x, trial.slope_y, kRadius,
                                      image.width, image.height);
    float ncc = kNoNcc;
    if (at.seen) ncc = ncc_from_sums(window, sum_window(at, image, middle, support.max_difference), support.samples);
    if (ncc > p.threshold) {
      trial.ncc_sum = add(trial.ncc_sum, ncc);
      ++trial.votes;
    }
    bool stays = can_win(trial.ncc_sum, trial.votes, p.neighbor_count - neighbor, plane.confidence, p.min_votes,
                         p.threshold, p.confidence_scale);
    if (stays && neighbor == p.neighbor_count)
      plane = taken_plane(trial, p.threshold, p.confidence_scale, move_index);
    trying = stays && neighbor < p.neighbor_count;
  }
  best[pixel] = plane;
}
