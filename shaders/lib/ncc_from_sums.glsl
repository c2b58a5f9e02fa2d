// Normalized cross-correlation from exact window sums (the paper, appendix A). Twin: engine/depth/window_ncc.h.

// Below every threshold: the neighbor does not see the window.
const float kNoNcc = -1.0;

struct WindowSums {
  ivec3 a;  // of a, per channel
  ivec3 b;  // of b, per channel
  int aa;   // of a * a, all channels
  int bb;   // of b * b, all channels
  int ab;   // of a * b, all channels
};

WindowSums no_sums() { return WindowSums(ivec3(0), ivec3(0), 0, 0, 0); }

void add_sample(inout WindowSums sums, ivec3 a, ivec3 b) {
  sums.a += a;
  sums.b += b;
  sums.aa += a.x * a.x + a.y * a.y + a.z * a.z;
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

float ncc_from_sums(WindowSums sums, int n) {
  float covariance = scaled_covariance(n, sums.ab, sums.a, sums.b);
  float variance_a = scaled_covariance(n, sums.aa, sums.a, sums.a);
  float variance_b = scaled_covariance(n, sums.bb, sums.b, sums.b);
  precise float ncc = (covariance * reciprocal_sqrt(variance_a)) * reciprocal_sqrt(variance_b);
  return ncc < 1.0 ? ncc : 1.0;
}
