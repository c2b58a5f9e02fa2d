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
  words[5] = uint(p.width);
  words[6] = uint(p.height);
  words[7] = uint(p.ends_round);
  words[8] = floatBitsToUint(p.max_tilt);
  words[9] = floatBitsToUint(p.threshold);
  words[10] = floatBitsToUint(p.confidence_scale);
}
