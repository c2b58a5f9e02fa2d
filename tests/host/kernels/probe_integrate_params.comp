// Writes each member of IntegrateParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { IntegrateParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 12; ++i) words[i] = floatBitsToUint(p.projection[i]);
  words[12] = floatBitsToUint(p.inverse_focal_x);
  words[13] = floatBitsToUint(p.inverse_focal_y);
  words[14] = floatBitsToUint(p.principal_x);
  words[15] = floatBitsToUint(p.principal_y);
  words[16] = floatBitsToUint(p.inverse_truncation);
  words[17] = uint(p.width);
  words[18] = uint(p.height);
  words[19] = uint(p.list_begin);
  words[20] = uint(p.blocks[0]);
  words[21] = uint(p.blocks[1]);
  words[22] = uint(p.pool_begin);
}
