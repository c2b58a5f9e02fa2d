// Writes each member of RefinePlanesParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { RefinePlanesParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  words[0] = uint(p.move.offset_x);
  words[1] = uint(p.move.offset_y);
  words[2] = floatBitsToUint(p.move.inverse_depth);
  words[3] = floatBitsToUint(p.move.slope_x);
  words[4] = floatBitsToUint(p.move.slope_y);
  words[5] = floatBitsToUint(p.move.near_depth);
  words[6] = floatBitsToUint(p.move.near_slope);
  words[7] = uint(p.move.undoes);
  words[8] = uint(p.width);
  words[9] = uint(p.height);
  words[10] = uint(p.tried);
  words[11] = uint(p.ends_round);
  words[12] = floatBitsToUint(p.max_tilt);
  words[13] = floatBitsToUint(p.threshold);
  words[14] = floatBitsToUint(p.confidence_scale);
}
