// Keeps the device busy: each thread goes a number of rounds, below 65536 because of DeviceInfo::max_loop_iterations.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Params { uint rounds; };
layout(std430, binding = 0) buffer Sum { uint sum; };

void main() {
  uint x = gl_GlobalInvocationID.x;
  for (uint i = 0u; i < rounds; ++i) x = x * 1664525u + 1013904223u;
  atomicAdd(sum, x);
}
