// Writes each member of its push constants, and of its specialization constants, as one word.
#version 450
layout(local_size_x = 1) in;
layout(constant_id = 3) const uint kWindow = 5;
layout(constant_id = 1) const float kScale = 0.5;
layout(constant_id = 2) const bool kMasked = false;
layout(push_constant) uniform Params {
  int first;
  uint second;
  float third;
  float neighbor_from_reference[9];
};
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };

void main() {
  words[0] = uint(first);
  words[1] = second;
  words[2] = floatBitsToUint(third);
  for (int i = 0; i < 9; ++i) words[3 + i] = floatBitsToUint(neighbor_from_reference[i]);
  words[12] = kWindow;
  words[13] = floatBitsToUint(kScale);
  words[14] = kMasked ? 1u : 0u;
}
