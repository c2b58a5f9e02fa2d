#include "engine/synthetic/hash.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quorum {
namespace {

TEST(Hash, ConsecutiveKeysGiveStandardNormalNoise) {
  constexpr int kCount = 200000;
  double sum = 0;
  double sum_of_squares = 0;
  double sum_of_products = 0;
  int beyond_two = 0;
  for (std::uint64_t key = 0; key < kCount; ++key) {
    const double value = gaussian_from_hash(key);
    sum += value;
    sum_of_squares += value * value;
    sum_of_products += value * gaussian_from_hash(key + 1);
    beyond_two += std::abs(value) > 2 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(sum_of_squares / kCount, 1, 0.02);
  EXPECT_NEAR(sum_of_products / kCount, 0, 0.01) << "neighbors are correlated";
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.003);
}

TEST(Hash, MixFollowsSplitMix64) { EXPECT_EQ(mix(0), 0xe220a8397b1dcdafULL); }

}  // namespace
}  // namespace quorum
