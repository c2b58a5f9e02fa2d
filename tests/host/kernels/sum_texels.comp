// Adds up the words of each of count texels, and the place of the texel.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Params { uint count; };
layout(binding = 0) uniform usamplerBuffer texels;
layout(std430, binding = 1) writeonly buffer Sums { uint sums[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec4 texel = texelFetch(texels, int(i));
  sums[i] = texel.x + texel.y + texel.z + texel.w + i;
}
