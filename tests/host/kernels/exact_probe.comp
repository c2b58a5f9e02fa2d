// The functions of lib/exact.glsl, value by value. Of each four words: a float, and integers a, b, c.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/exact.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Params { uint count; };
layout(std430, binding = 0) readonly buffer Values { uvec4 values[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec4 value = values[i];
  float x = uintBitsToFloat(value.x);
  int a = int(value.y);
  int b = int(value.z);
  int c = int(value.w);
  results[i] = vec4(reciprocal(x), reciprocal_sqrt(x), float_from_integer(multiply(a, b)),
                    float_from_integer(subtract(multiply(a, b), multiply(c, c))));
}
