// Bilinear interpolation in integers. Twin: engine/image/padded_image.h.

// The sample at (u, v), in 1/256 pixel, from its four texels; centered, 24 - shift bits a channel. Red and blue share a
// word along x: the exact results fit 16 bits each, so arithmetic modulo 2^32 on both at once gives both.
ivec3 sample_bilinear(uint p00, uint p10, uint p01, uint p11, int u, int v, int shift) {
  uint fraction_x = uint(u & (kPositionScale - 1));
  uint fraction_y = uint(v & (kPositionScale - 1));
  const uint kRedBlue = 0x00ff00ffu;
  uvec2 upper_left = uvec2(p00 & kRedBlue, (p00 >> 8) & 0xffu);
  uvec2 lower_left = uvec2(p01 & kRedBlue, (p01 >> 8) & 0xffu);
  uvec2 upper = (upper_left << 8) + (uvec2(p10 & kRedBlue, (p10 >> 8) & 0xffu) - upper_left) * fraction_x;
  uvec2 lower = (lower_left << 8) + (uvec2(p11 & kRedBlue, (p11 >> 8) & 0xffu) - lower_left) * fraction_x;
  uvec3 top = uvec3(upper.x & 0xffffu, upper.y, upper.x >> 16);
  uvec3 bottom = uvec3(lower.x & 0xffffu, lower.y, lower.x >> 16);
  return ivec3(((top << 8) + (bottom - top) * fraction_y) >> shift) - (1 << (23 - shift));
}

// The sample at a pixel's center.
ivec3 sample_pixel(uint pixel, int shift) {
  return ivec3(((uvec3(pixel) >> uvec3(0, 8, 16)) & 0xffu) << 16 >> shift) - (1 << (23 - shift));
}
