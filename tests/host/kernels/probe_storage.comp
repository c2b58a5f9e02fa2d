// Writes each member of three of each struct that storage buffers hold as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 1) readonly buffer Votes { PixelVote votes[]; };
layout(std430, binding = 2) readonly buffer Items { SweepItem items[]; };
layout(std430, binding = 3) readonly buffer Blocks { SweepBlock blocks[]; };
layout(std430, binding = 4) readonly buffer Windows { ReferenceWindow windows[]; };
layout(std430, binding = 5) readonly buffer Supports { SupportWindow supports[]; };
layout(std430, binding = 6) writeonly buffer Words { uint words[]; };

void main() {
  for (int i = 0; i < 3; ++i) {
    int first = 23 * i;
    words[first] = ranges[i].first;
    words[first + 1] = ranges[i].last;
    words[first + 2] = floatBitsToUint(votes[i].correlation);
    words[first + 3] = floatBitsToUint(votes[i].confidence);
    words[first + 4] = uint(votes[i].plane);
    words[first + 5] = uint(items[i].x);
    words[first + 6] = uint(items[i].y);
    words[first + 7] = uint(items[i].plane);
    words[first + 8] = floatBitsToUint(items[i].inverse_depth);
    words[first + 9] = uint(blocks[i].x);
    words[first + 10] = uint(blocks[i].y);
    words[first + 11] = uint(blocks[i].item_begin);
    words[first + 12] = uint(blocks[i].item_count);
    for (int channel = 0; channel < 3; ++channel) words[first + 13 + channel] = uint(windows[i].sum[channel]);
    words[first + 16] = floatBitsToUint(windows[i].inverse_deviation);
    for (int channel = 0; channel < 3; ++channel) words[first + 17 + channel] = uint(supports[i].sum[channel]);
    words[first + 20] = floatBitsToUint(supports[i].inverse_deviation);
    words[first + 21] = uint(supports[i].samples);
    words[first + 22] = uint(supports[i].max_difference);
  }
}
