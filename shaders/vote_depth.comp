// The votes of a batch of items: counts and sums over the neighbors, and the best plane of each pixel so far (the paper,
// section 2.1). An invocation takes four pixels of a row of a block. Twin: engine/depth/vote_depth.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"
#include "lib/vote.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { VoteParams p; };
layout(std430, binding = 0) readonly buffer Blocks { SweepBlock blocks[]; };
layout(std430, binding = 1) readonly buffer Items { SweepItem items[]; };
layout(std430, binding = 2) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 3) readonly buffer Ncc { vec4 ncc_values[]; };
layout(std430, binding = 4) buffer Votes { PixelVote votes[]; };

void main() {
  int quads = p.block_side / 4;  // in a row of a block
  int quad = int(gl_GlobalInvocationID.x) % (quads * p.block_side);
  int block_index = int(gl_GlobalInvocationID.x) / (quads * p.block_side);
  if (block_index >= p.block_count) return;
  SweepBlock block = blocks[block_index];
  int x = block.x + quad % quads * 4;
  int y = block.y + quad / quads;
  if (x >= p.width || y >= p.height) return;

  PlaneRange range[4];
  PixelVote best[4];
  uint first = ~0u;
  uint last = 0u;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    range[i] = PlaneRange(1u, 0u);
    best[i] = PixelVote(0.0, 0.0, -1);
    if (x + i >= p.width) continue;
    range[i] = ranges[y * p.width + x + i];
    if (range[i].first > range[i].last) continue;
    best[i] = votes[y * p.width + x + i];
    first = min(first, range[i].first);
    last = max(last, range[i].last);
  }
  if (first > last) return;
  for (int item = block.item_begin; item < block.item_begin + block.item_count; ++item) {
    int plane = items[item].plane;
    if (uint(plane) < first || uint(plane) > last) continue;
    precise vec4 ncc_sum = vec4(0.0);
    ivec4 count = ivec4(0);
    for (int neighbor = 0; neighbor < p.neighbor_count; ++neighbor) {
      vec4 ncc = ncc_values[(neighbor * p.item_count + item) * quads * p.block_side + quad];
      bvec4 votes_for = greaterThan(ncc, vec4(p.threshold));
      ncc_sum = ncc_sum + mix(vec4(0.0), ncc, votes_for);
      count += ivec4(votes_for);
    }
    [[unroll]] for (int i = 0; i < 4; ++i)
      if (uint(plane) >= range[i].first && uint(plane) <= range[i].last)
        best[i] = vote(best[i], ncc_sum[i], count[i], plane, p);
  }
  [[unroll]] for (int i = 0; i < 4; ++i)
    if (range[i].first <= range[i].last) votes[y * p.width + x + i] = best[i];
}
