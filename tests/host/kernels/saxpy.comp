// y = a x + y, for count values.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Params {
  uint count;
  float a;
};
layout(std430, binding = 0) readonly buffer X { float x[]; };
layout(std430, binding = 1) buffer Y { float y[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) y[i] = a * x[i] + y[i];
}
