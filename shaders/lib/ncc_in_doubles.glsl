// Normalized cross-correlation from exact window sums as in ncc_from_sums.glsl, by double arithmetic that is exact below
// 2^53: on CPUs, and so on software Vulkan, much faster than 64-bit integers made of two words.
// Twin: engine/depth/window_ncc.cc, and float_from_integer in engine/core/exact.h.

// The 24 leading bits of an integer, toward zero, as float. value: below 2^53.
float float_from_integer(double value) {
  uvec2 words = unpackDouble2x32(value);
  return float(packDouble2x32(uvec2(words.x & 0xe0000000u, words.y)));
}

// n * product_sum - a . b: n^2 times the covariance.
float scaled_covariance_in_doubles(int n, int product_sum, dvec3 a, dvec3 b) {
  return float_from_integer(double(n) * double(product_sum) - (a.x * b.x + a.y * b.y + a.z * b.z));
}

// n: samples a channel. sum_a, inverse_deviation: of a ReferenceWindow. sum_b, bb, ab: as in WindowSums.
float ncc_in_doubles(int n, ivec3 sum_a, float inverse_deviation, ivec3 sum_b, int bb, int ab) {
  dvec3 a = dvec3(sum_a);
  dvec3 b = dvec3(sum_b);
  float covariance = scaled_covariance_in_doubles(n, ab, a, b);
  float variance = scaled_covariance_in_doubles(n, bb, b, b);
  precise float ncc = (covariance * inverse_deviation) * reciprocal_sqrt(variance);
  return ncc < 1.0 ? ncc : 1.0;
}
