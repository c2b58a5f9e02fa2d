// Counts in each cell of a width x height x depth box how often a thread has come by, plus a multiple of its index.
#version 450
layout(local_size_x_id = 0, local_size_y_id = 1, local_size_z = 2) in;
layout(constant_id = 0) const uint kGroupWidth = 8;
layout(constant_id = 7) const uint kStep = 1000;
layout(push_constant) uniform Params {
  uint width;
  uint height;
  uint depth;
};
layout(std430, binding = 0) buffer Cells { uint cells[]; };

void main() {
  uvec3 p = gl_GlobalInvocationID;
  if (p.x >= width || p.y >= height || p.z >= depth) return;
  uint i = (p.z * height + p.y) * width + p.x;
  atomicAdd(cells[i], 1u + i * kStep);
}
