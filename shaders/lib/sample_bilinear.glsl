// Bilinear interpolation in integers. Twin: engine/image/sample_bilinear.h.

// Two texels interpolated along x, 16 bits a channel: red and blue, green. Red and blue share a word: the exact results
// fit 16 bits each, so arithmetic modulo 2^32 on both at once gives both.
uvec2 interpolate_along_x(uint left, uint right, int u) {
  const uint kRedBlue = 0x00ff00ffu;
  uint fraction = uint(u & (kPositionScale - 1));
  uvec2 from = uvec2(left & kRedBlue, (left >> 8) & 0xffu);
  return (from << 8) + (uvec2(right & kRedBlue, (right >> 8) & 0xffu) - from) * fraction;
}

ivec3 interpolate_along_y(uvec2 top, uvec2 bottom, int v, int shift) {
  uint fraction = uint(v & (kPositionScale - 1));
  uvec3 from = uvec3(top.x & 0xffffu, top.y, top.x >> 16);
  uvec3 to = uvec3(bottom.x & 0xffffu, bottom.y, bottom.x >> 16);
  return ivec3(((from << 8) + (to - from) * fraction) >> shift) - (1 << (23 - shift));
}

// The sample at (u, v), in 1/256 pixel, from its four texels; centered, 24 - shift bits a channel.
ivec3 sample_bilinear(uint p00, uint p10, uint p01, uint p11, int u, int v, int shift) {
  return interpolate_along_y(interpolate_along_x(p00, p10, u), interpolate_along_x(p01, p11, u), v, shift);
}

uvec3 channels_of(uint pixel) { return (uvec3(pixel) >> uvec3(0, 8, 16)) & 0xffu; }

// The sample at a pixel's center.
ivec3 sample_pixel(uint pixel, int shift) { return ivec3(channels_of(pixel) << 16 >> shift) - (1 << (23 - shift)); }

// Index of the upper left of the four texels of a position in 1/256 pixel.
int texel_index(int u, int v, int stride) { return (v >> kPositionBits) * stride + (u >> kPositionBits); }

// By how much two pixels differ in the channel in which they differ most.
int largest_difference(uint a, uint b) {
  ivec3 difference = abs(ivec3(channels_of(b)) - ivec3(channels_of(a)));
  return max(max(difference.x, difference.y), difference.z);
}
