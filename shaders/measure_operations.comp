// How fast a device computes: 32-bit multiplications and additions on independent values in registers, as on the CPU in
// engine/core/host_rates.cc. Only its time counts (host/device_rates.cc).
#version 460
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { uint rounds; };
layout(std430, binding = 0) buffer Values { uint values[]; };

const int kChains = 16;  // enough to hide a multiplication's latency; twice as many operations a round

void main() {
  uint start = values[gl_GlobalInvocationID.x];
  uint factor = start | 1u;
  uint chain[kChains];
  [[unroll]] for (int i = 0; i < kChains; ++i) chain[i] = start + uint(i);
  for (uint round = 0u; round < rounds; ++round) {
    [[unroll]] for (int i = 0; i < kChains; ++i) chain[i] = chain[i] * factor + 12345u;
  }
  uint sum = 0u;
  [[unroll]] for (int i = 0; i < kChains; ++i) sum ^= chain[i];
  values[gl_GlobalInvocationID.x] = sum;  // so that no chain is left out
}
