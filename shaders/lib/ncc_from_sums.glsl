// Normalized cross-correlation from exact window sums (the paper, appendix A), in integers of two words, since GPUs
// compute slowly in double. Twin: engine/depth/window_ncc.h. The form for software Vulkan: ncc_in_doubles.glsl.

// Below every threshold: the neighbor does not see the window.
const float kNoNcc = -1.0;

struct WindowSums {
  ivec3 b;  // of b, per channel
  int bb;   // of b * b, all channels
  int ab;   // of a * b, all channels
};

WindowSums no_sums() { return WindowSums(ivec3(0), 0, 0); }

void add_sample(inout WindowSums sums, ivec3 a, ivec3 b) {
  sums.b += b;
  sums.bb += b.x * b.x + b.y * b.y + b.z * b.z;
  sums.ab += a.x * b.x + a.y * b.y + a.z * b.z;
}

// n * product_sum - a . b: n^2 times the covariance.
float scaled_covariance(int n, int product_sum, ivec3 a, ivec3 b) {
  Int64 value = multiply(n, product_sum);
  value = subtract(value, multiply(a.x, b.x));
  value = subtract(value, multiply(a.y, b.y));
  value = subtract(value, multiply(a.z, b.z));
  return float_from_integer(value);
}

// window: of the reference. sums: of its products with the neighbor, n samples a channel.
float ncc_from_sums(ReferenceWindow window, WindowSums sums, int n) {
  float covariance = scaled_covariance(n, sums.ab, ivec3(window.sum[0], window.sum[1], window.sum[2]), sums.b);
  float variance = scaled_covariance(n, sums.bb, sums.b, sums.b);
  precise float ncc = (covariance * window.inverse_deviation) * reciprocal_sqrt(variance);
  return ncc < 1.0 ? ncc : 1.0;
}
