// The votes of a batch of planes: counts and sums over the neighbors, and the best plane of each pixel so far (the
// paper, section 2.1). Twin: engine/depth/vote_depth.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/vote.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { VoteParams p; };
layout(std430, binding = 0) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 1) readonly buffer Ncc { float ncc_values[]; };
layout(std430, binding = 2) buffer Votes { PixelVote votes[]; };

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  if (x >= p.width || row >= p.row_count) return;
  int pixel = (p.row_begin + row) * p.width + x;
  PlaneRange range = ranges[pixel];
  if (range.first > range.last) return;
  PixelVote best = votes[pixel];
  for (int slot = 0; slot < p.plane_count; ++slot) {
    uint plane = uint(p.first_plane + slot * p.plane_stride) + (p.relative_planes != 0 ? range.first : 0u);
    if (plane < range.first || plane > range.last) continue;
    precise float ncc_sum = 0.0;
    int count = 0;
    for (int neighbor = 0; neighbor < p.neighbor_count; ++neighbor) {
      float ncc = ncc_values[((neighbor * p.plane_count + slot) * p.row_count + row) * p.width + x];
      if (ncc > p.threshold) {
        ncc_sum = ncc_sum + ncc;
        ++count;
      }
    }
    best = vote(best, ncc_sum, count, int(plane), p);
  }
  votes[pixel] = best;
}
