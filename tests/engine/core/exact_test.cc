#include "engine/core/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace quorum {
namespace {

TEST(Exact, ReciprocalIsWithinTwoUnitsInTheLastPlace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-25.0, 25.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const auto x = static_cast<float>(std::pow(10.0, exponent(random)));
    const double truth = 1.0 / static_cast<double>(x);
    worst = std::max(worst, std::abs(static_cast<double>(reciprocal(x)) - truth) / truth);
  }
  EXPECT_LT(worst, 2.0 * 0x1p-23);
  EXPECT_GT(worst, 0.0);
}

TEST(Exact, ReciprocalSqrtIsWithinThreeUnitsInTheLastPlace) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-25.0, 25.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const auto x = static_cast<float>(std::pow(10.0, exponent(random)));
    const double truth = 1.0 / std::sqrt(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(reciprocal_sqrt(x)) - truth) / truth);
  }
  EXPECT_LT(worst, 3.0 * 0x1p-23);
  EXPECT_GT(worst, 0.0);
}

TEST(Exact, ReciprocalSqrtOfZeroIsFinite) {
  EXPECT_TRUE(std::isfinite(reciprocal_sqrt(0.0F)));
  EXPECT_EQ(0.0F * reciprocal_sqrt(0.0F), 0.0F);
}

TEST(Exact, IntegersUpTo24BitsStayAsTheyAre) {
  for (const double value : {0.0, 1.0, -1.0, 4095.0, 16777215.0, -16777215.0, 16777216.0 * 4096.0})
    EXPECT_EQ(static_cast<double>(float_from_integer(value)), value);
}

TEST(Exact, LargerIntegersAreCutTowardZero) {
  EXPECT_EQ(float_from_integer(33554431.0), 33554430.0F);  // 2^25 - 1: rounding to nearest would give 2^25
  EXPECT_EQ(float_from_integer(-33554431.0), -33554430.0F);
  EXPECT_EQ(float_from_integer(9007199254740991.0), 9007198717870080.0F);  // 2^53 - 1
}

}  // namespace
}  // namespace quorum
