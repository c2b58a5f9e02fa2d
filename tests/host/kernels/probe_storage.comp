// Writes each member of three PlaneRange and three PixelVote as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 1) readonly buffer Votes { PixelVote votes[]; };
layout(std430, binding = 2) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 3; ++i) {
    words[5 * i] = ranges[i].first;
    words[5 * i + 1] = ranges[i].last;
    words[5 * i + 2] = floatBitsToUint(votes[i].correlation);
    words[5 * i + 3] = floatBitsToUint(votes[i].confidence);
    words[5 * i + 4] = uint(votes[i].plane);
  }
}
