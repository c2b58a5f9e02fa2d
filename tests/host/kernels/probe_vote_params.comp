// Writes each member of VoteParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { VoteParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  words[0] = uint(p.width);
  words[1] = uint(p.height);
  words[2] = uint(p.block_width);
  words[3] = uint(p.block_height);
  words[4] = uint(p.block_count);
  words[5] = uint(p.item_count);
  words[6] = uint(p.neighbor_count);
  words[7] = uint(p.min_votes);
  words[8] = floatBitsToUint(p.threshold);
  words[9] = floatBitsToUint(p.confidence_scale);
}
