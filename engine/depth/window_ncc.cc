#include "engine/depth/window_ncc.h"

#include "engine/core/exact.h"

namespace quorum {
namespace {

/// n * product_sum - sum_a · sum_b: n² times the covariance. Below 2^53, so exact in double.
double scaled_covariance(int n, std::int32_t product_sum, const std::int32_t (&a)[3], const std::int32_t (&b)[3]) {
  const auto product = [&](int channel) { return static_cast<double>(a[channel]) * static_cast<double>(b[channel]); };
  return static_cast<double>(n) * product_sum - (product(0) + product(1) + product(2));
}

}  // namespace

float ncc_from_sums(const WindowSums& sums, int n) {
  const float covariance = float_from_integer(scaled_covariance(n, sums.ab, sums.a, sums.b));
  const float variance_a = float_from_integer(scaled_covariance(n, sums.aa, sums.a, sums.a));
  const float variance_b = float_from_integer(scaled_covariance(n, sums.bb, sums.b, sums.b));
  // A flat window has covariance 0, and reciprocal_sqrt(0) is finite: the product is 0 without a branch.
  const float ncc = (covariance * reciprocal_sqrt(variance_a)) * reciprocal_sqrt(variance_b);
  return ncc < 1.0F ? ncc : 1.0F;
}

}  // namespace quorum
