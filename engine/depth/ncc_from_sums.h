// Normalized cross-correlation of two windows from exact sums (the paper, appendix A).
// Twin: shaders/lib/ncc_from_sums.glsl.
#pragma once

#include <cstdint>

#include "engine/core/exact.h"
#include "engine/image/sample_bilinear.h"
#include "shaders/layout.h"

namespace quorum {

/// Below every threshold: the neighbor does not see the window.
constexpr float kNoNcc = -1.0F;

/// Sums over the samples of a window in a neighbor (b), and of their products with the reference (a). Integers, so any
/// order gives the same.
struct WindowSums {
  std::int32_t b[3] = {};  ///< of b, per channel
  std::int32_t bb = 0;     ///< of b * b, all channels
  std::int32_t ab = 0;     ///< of a * b, all channels
};

/// The product of two samples, summed over the channels.
[[gnu::always_inline]] inline std::int32_t product(const Sample& a, const Sample& b) {
  return a.red * b.red + a.green * b.green + a.blue * b.blue;
}

/// Adds a sample of the neighbor, whose counterpart in the reference is a.
[[gnu::always_inline]] inline void add_sample(WindowSums& sums, const Sample& a, const Sample& b) {
  sums.b[0] += b.red, sums.b[1] += b.green, sums.b[2] += b.blue;
  sums.bb += product(b, b);
  sums.ab += product(a, b);
}

/// n * product_sum - a · b: n² times the covariance. Below 2^53, so exact in double.
[[gnu::always_inline]] inline float scaled_covariance(int n, std::int32_t product_sum, const std::int32_t (&a)[3],
                                                      const std::int32_t (&b)[3]) {
  const auto multiply = [](std::int32_t x, std::int32_t y) { return static_cast<double>(x) * static_cast<double>(y); };
  return float_from_integer(multiply(n, product_sum) -
                            (multiply(a[0], b[0]) + multiply(a[1], b[1]) + multiply(a[2], b[2])));
}

/// Normalized cross-correlation with a mean per channel, -1..1; 0 if either window is flat. window: of the reference.
/// sums: of n samples a channel, as sample_bilinear gives them. Cannot fail. Source: the paper, appendix A.
[[gnu::always_inline]] inline float ncc_from_sums(const ReferenceWindow& window, const WindowSums& sums, int n) {
  const float covariance = scaled_covariance(n, sums.ab, window.sum, sums.b);
  const float variance = scaled_covariance(n, sums.bb, sums.b, sums.b);
  // A flat window has covariance 0, and reciprocal_sqrt(0) is finite: the product is 0 without a branch.
  const float ncc = (covariance * window.inverse_deviation) * reciprocal_sqrt(variance);
  return ncc < 1.0F ? ncc : 1.0F;
}

}  // namespace quorum
