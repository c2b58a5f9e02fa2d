// Writes each member of CollectParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { CollectParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 9; ++i) words[i] = floatBitsToUint(p.ray_from_pixel[i]);
  for (int i = 0; i < 3; ++i) words[9 + i] = floatBitsToUint(p.origin[i]);
  for (int i = 0; i < 3; ++i) words[12 + i] = uint(p.blocks[i]);
  words[15] = uint(p.width);
  words[16] = uint(p.height);
  words[17] = floatBitsToUint(p.depth_step);
  words[18] = uint(p.steps);
  words[19] = floatBitsToUint(p.margin);
}
