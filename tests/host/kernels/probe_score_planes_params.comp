// Writes each member of ScorePlanesParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { ScorePlanesParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 9; ++i) words[i] = floatBitsToUint(p.warp.rotation[i]);
  for (int i = 0; i < 3; ++i) words[9 + i] = floatBitsToUint(p.warp.offset[i]);
  words[12] = uint(p.width);
  words[13] = uint(p.height);
  words[14] = uint(p.neighbor_width);
  words[15] = uint(p.neighbor_height);
  words[16] = uint(p.left);
  words[17] = uint(p.min_votes);
  words[18] = floatBitsToUint(p.threshold);
  words[19] = floatBitsToUint(p.confidence_scale);
}
