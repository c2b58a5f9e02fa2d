// Bilinear interpolation in integers. Twin: engine/image/padded_image.h.

// The sample at (u, v), in 1/256 pixel, from its four texels; centered, 24 - shift bits a channel.
ivec3 sample_bilinear(uint p00, uint p10, uint p01, uint p11, int u, int v, int shift) {
  int fraction_x = u & (kPositionScale - 1);
  int fraction_y = v & (kPositionScale - 1);
  int center = 1 << (23 - shift);
  uvec3 byte = uvec3(0, 8, 16);
  ivec3 c00 = ivec3((uvec3(p00) >> byte) & 0xffu);
  ivec3 c10 = ivec3((uvec3(p10) >> byte) & 0xffu);
  ivec3 c01 = ivec3((uvec3(p01) >> byte) & 0xffu);
  ivec3 c11 = ivec3((uvec3(p11) >> byte) & 0xffu);
  ivec3 top = c00 * (kPositionScale - fraction_x) + c10 * fraction_x;
  ivec3 bottom = c01 * (kPositionScale - fraction_x) + c11 * fraction_x;
  return ((top * (kPositionScale - fraction_y) + bottom * fraction_y) >> shift) - center;
}

// The sample at a pixel's center.
ivec3 sample_pixel(uint pixel, int shift) {
  return ivec3(((uvec3(pixel) >> uvec3(0, 8, 16)) & 0xffu) << 16 >> shift) - (1 << (23 - shift));
}
