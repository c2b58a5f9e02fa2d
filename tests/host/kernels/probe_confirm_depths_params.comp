// Writes each member of ConfirmDepthsParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { ConfirmDepthsParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 9; ++i) words[i] = floatBitsToUint(p.warp.rotation[i]);
  for (int i = 0; i < 3; ++i) words[9 + i] = floatBitsToUint(p.warp.offset[i]);
  for (int i = 0; i < 9; ++i) words[12 + i] = floatBitsToUint(p.back.rotation[i]);
  for (int i = 0; i < 3; ++i) words[21 + i] = floatBitsToUint(p.back.offset[i]);
  words[24] = uint(p.width);
  words[25] = uint(p.height);
  words[26] = uint(p.other_width);
  words[27] = uint(p.other_height);
  words[28] = floatBitsToUint(p.other_max_step);
  words[29] = floatBitsToUint(p.footprint);
  words[30] = floatBitsToUint(p.other_footprint);
  words[31] = p.steps;
}
