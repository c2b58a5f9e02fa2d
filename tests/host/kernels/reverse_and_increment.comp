// Result of one thread depends on what a distant thread of the dispatch before has written.
#version 450
layout(local_size_x = 32) in;
layout(push_constant) uniform Params { uint count; };
layout(std430, binding = 0) readonly buffer From { uint from[]; };
layout(std430, binding = 1) writeonly buffer To { uint to[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) to[i] = from[count - 1u - i] + 1u;
}
