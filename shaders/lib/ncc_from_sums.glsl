// Normalized cross-correlation from exact window sums (the paper, appendix A). Twin: engine/depth/ncc_from_sums.h.
// In integers of two words, since GPUs compute slowly in double. Kernels for software Vulkan define NCC_IN_DOUBLES: up
// to 2^53 doubles are exact, too, and on CPUs much faster.
#include "lib/exact.glsl"

// Below every threshold: the neighbor does not see the window.
const float kNoNcc = -1.0;

struct WindowSums {
  ivec3 b;  // of b, per channel
  int bb;   // of b * b, all channels
  int ab;   // of a * b, all channels
};

WindowSums no_sums() { return WindowSums(ivec3(0), 0, 0); }

// The product of two samples, summed over the channels.
int product(ivec3 a, ivec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

void add_sample(inout WindowSums sums, ivec3 a, ivec3 b) {
  sums.b += b;
  sums.bb += product(b, b);
  sums.ab += product(a, b);
}

// n * product_sum - a . b: n^2 times the covariance.
#ifdef NCC_IN_DOUBLES
// The 24 leading bits of an integer, toward zero, as float. value: below 2^53.
float float_from_integer(double value) {
  uvec2 words = unpackDouble2x32(value);
  return float(packDouble2x32(uvec2(words.x & 0xe0000000u, words.y)));
}

float scaled_covariance(int n, int product_sum, ivec3 a, ivec3 b) {
  dvec3 products = dvec3(a) * dvec3(b);
  return float_from_integer(double(n) * double(product_sum) - (products.x + products.y + products.z));
}
#else
float scaled_covariance(int n, int product_sum, ivec3 a, ivec3 b) {
  Int64 value = multiply(n, product_sum);
  value = subtract(value, multiply(a.x, b.x));
  value = subtract(value, multiply(a.y, b.y));
  value = subtract(value, multiply(a.z, b.z));
  return float_from_integer(value);
}
#endif

// window: of the reference. sums: of n samples a channel.
float ncc_from_sums(ReferenceWindow window, WindowSums sums, int n) {
  float covariance = scaled_covariance(n, sums.ab, ivec3(window.sum[0], window.sum[1], window.sum[2]), sums.b);
  float variance = scaled_covariance(n, sums.bb, sums.b, sums.b);
  precise float ncc = (covariance * window.inverse_deviation) * reciprocal_sqrt(variance);
  return ncc < 1.0 ? ncc : 1.0;
}
