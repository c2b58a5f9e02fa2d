// The kernel of vote_depth.comp and vote_depth_lanes.comp, which differ in how they read. An invocation takes four
// pixels of a row of a block.
#include "lib/vote.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;

void main() {
  int quads = p.block_width / 4;  // in a row of a block
  int block_quads = quads * p.block_height;
  int quad = int(gl_GlobalInvocationID.x) % block_quads;
  int block_index = int(gl_GlobalInvocationID.x) / block_quads;
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
    int plane = plane_of_item(item);
    if (uint(plane) < first || uint(plane) > last) continue;
    precise vec4 ncc_sum = vec4(0.0);
    ivec4 count = ivec4(0);
    for (int neighbor = 0; neighbor < p.neighbor_count; ++neighbor) {
      vec4 ncc = ncc_of_quad((neighbor * p.item_count + item) * block_quads + quad);
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
