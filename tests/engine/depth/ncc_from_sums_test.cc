#include "engine/depth/ncc_from_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/depth/reference_windows.h"

namespace quorum {
namespace {

using Window = std::vector<std::array<int, 3>>;

/// NCC of b against the reference a.
float ncc_of(const Window& a, const Window& b) {
  ReferenceSums reference;
  WindowSums sums;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Sample sample{a[i][0], a[i][1], a[i][2]};
    add_sample(reference, sample);
    add_sample(sums, sample, {b[i][0], b[i][1], b[i][2]});
  }
  const int samples = static_cast<int>(a.size());
  return ncc_from_sums(window_from_sums(reference, samples), sums, samples);
}

/// Appendix A of the paper in double precision.
double ncc_in_double(const Window& a, const Window& b) {
  std::array<double, 3> mean_a = {};
  std::array<double, 3> mean_b = {};
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) mean_a[c] += a[i][c] / n, mean_b[c] += b[i][c] / n;
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      ab += (a[i][c] - mean_a[c]) * (b[i][c] - mean_b[c]);
      aa += (a[i][c] - mean_a[c]) * (a[i][c] - mean_a[c]);
      bb += (b[i][c] - mean_b[c]) * (b[i][c] - mean_b[c]);
    }
  }
  return ab / std::sqrt(aa * bb);
}

Window random_window(std::mt19937& random, int side, int low, int high) {
  std::uniform_int_distribution<int> uniform(low, high);
  Window window(static_cast<std::size_t>(side * side));
  for (auto& sample : window)
    for (int& channel : sample) channel = uniform(random);
  return window;
}

TEST(Ncc, AgreesWithTheAppendixInDoublePrecision) {
  std::mt19937 random(1);
  for (const int side : {3, 5, 9, 13}) {
    for (int i = 0; i < 500; ++i) {
      const Window a = random_window(random, side, -2048, 2032);
      Window b = random_window(random, side, -2048, 2032);
      if (i % 2 == 0)
        for (std::size_t j = 0; j < b.size(); ++j)
          for (std::size_t c = 0; c < 3; ++c) b[j][c] = (b[j][c] + 3 * a[j][c]) / 4;
      EXPECT_NEAR(ncc_of(a, b), ncc_in_double(a, b), 1e-6);
    }
  }
}

TEST(Ncc, GainAndOffsetLeaveItUnchanged) {
  std::mt19937 random(2);
  const Window a = random_window(random, 5, -500, 500);
  Window b = a;
  for (auto& sample : b)
    for (std::size_t c = 0; c < 3; ++c) sample[c] = 3 * sample[c] + 100 * static_cast<int>(c);
  EXPECT_NEAR(ncc_of(a, b), 1.0F, 1e-6F);
}

TEST(Ncc, OppositeWindowsGiveMinusOne) {
  std::mt19937 random(3);
  const Window a = random_window(random, 5, -500, 500);
  Window b = a;
  for (auto& sample : b)
    for (int& channel : sample) channel = -channel;
  EXPECT_NEAR(ncc_of(a, b), -1.0F, 1e-6F);
}

TEST(Ncc, FlatWindowsGiveZero) {
  std::mt19937 random(4);
  const Window textured = random_window(random, 5, -500, 500);
  const Window flat(25, {7, -3, 1000});
  EXPECT_EQ(ncc_of(textured, flat), 0.0F);
  EXPECT_EQ(ncc_of(flat, textured), 0.0F);
  EXPECT_EQ(ncc_of(flat, flat), 0.0F);
  EXPECT_EQ(ncc_from_sums(ReferenceWindow{}, WindowSums{}, 25), 0.0F);
}

TEST(Ncc, NeverExceedsOne) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    const Window a = random_window(random, 3, -3, 3);
    EXPECT_LE(ncc_of(a, a), 1.0F);
  }
}

TEST(Ncc, HoldsAtTheLargestContrast) {
  Window a(169, {2032, 2032, 2032});
  for (std::size_t i = 0; i < a.size(); i += 2) a[i] = {-2048, -2048, -2048};
  EXPECT_NEAR(ncc_of(a, a), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace quorum
