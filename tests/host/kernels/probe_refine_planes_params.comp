// Writes each member of RefinePlanesParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { RefinePlanesParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  words[0] = uint(p.width);
  words[1] = uint(p.height);
  words[2] = uint(p.row_begin);
  words[3] = uint(p.row_end);
  words[4] = uint(p.move_begin);
  words[5] = uint(p.move_end);
  words[6] = uint(p.neighbor_count);
  words[7] = uint(p.is_first);
  words[8] = uint(p.min_votes);
  words[9] = floatBitsToUint(p.max_tilt);
  words[10] = floatBitsToUint(p.threshold);
  words[11] = floatBitsToUint(p.confidence_scale);
}
