// Writes each member of ReferenceWindowsParams as one word.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform Push { ReferenceWindowsParams p; };
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  words[0] = uint(p.width);
  words[1] = uint(p.height);
  words[2] = uint(p.columns);
  words[3] = uint(p.rows);
}
