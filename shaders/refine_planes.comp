// Takes the trials that won, and makes the next ones by a move, or ends the round (beyond the paper: windows that lie
// on the surface). Twin: engine/depth/refine_planes.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/plane_moves.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;

layout(push_constant) uniform Push { RefinePlanesParams p; };
layout(std430, binding = 0) readonly buffer Ranges { InverseDepthRange ranges[]; };
layout(std430, binding = 1) buffer Last { PixelPlane last[]; };  // planes of the last round
layout(std430, binding = 2) buffer Best { PixelPlane best[]; };  // so far
layout(std430, binding = 3) buffer Trials { PlaneTrial trials[]; };

void main() {
  int pixel = int(gl_GlobalInvocationID.x);
  if (pixel >= p.width * p.height) return;
  InverseDepthRange range = ranges[pixel];
  if (range.farthest > range.nearest) return;
  PixelPlane plane = best[pixel];
  PlaneTrial tried = trials[pixel];
  if (tried.inverse_depth != 0.0) {
    plane = taken_plane(tried, p.threshold, p.confidence_scale, p.tried);
    best[pixel] = plane;
  }
  PlaneTrial trial = kNoTrial;
  if (p.ends_round != 0) {
    last[pixel] = plane;
    plane.taken_by = 0;
    best[pixel] = plane;
  } else {
    int x = pixel % p.width + p.move.offset_x;
    int y = pixel / p.width + p.move.offset_y;
    PixelPlane other = PixelPlane(0.0, 0.0, 0.0, 0.0, 0.0, 0);
    if (x >= 0 && y >= 0 && x < p.width && y < p.height) other = last[y * p.width + x];
    trial = move_plane(p.move, plane, other);
    if (trial.inverse_depth != 0.0 && !may_take(trial, range, p.max_tilt)) trial = kNoTrial;
  }
  trials[pixel] = trial;
}
