#include "engine/core/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace quorum {
namespace {

/// The features of the first processor, as Linux lists them; none elsewhere.
std::set<std::string> processor_features() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("flags")) continue;
    std::istringstream words(line.substr(line.find(':') + 1));
    return {std::istream_iterator<std::string>(words), {}};
  }
  return {};
}

[[gnu::always_inline]] inline void add_products(const std::array<float, 100>& a, std::array<float, 100>& sum) {
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i] * a[i];
}

TEST(Simd, TheLevelIsThatOfTheFeatures) {
  const std::set<std::string> features = processor_features();
  if (features.empty()) GTEST_SKIP() << "no list of features";
  const auto has = [&](const auto& names) {
    return std::ranges::all_of(names, [&](const char* name) { return features.contains(name); });
  };
  const bool v3 = has(std::array{"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"});
  const bool v4 = v3 && has(std::array{"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"});
  EXPECT_EQ(best_simd_level(), v4 ? SimdLevel::kAvx512 : v3 ? SimdLevel::kAvx2 : SimdLevel::kBaseline);
}

TEST(Simd, EveryFormGivesTheSameBits) {
  std::array<float, 100> values = {};
  std::array<float, 100> expected = {};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1F * static_cast<float>(i);
  std::ranges::transform(values, expected.begin(), [](float value) { return 1.0F + value * value; });
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    std::array<float, 100> sum = {};
    sum.fill(1.0F);
    simd_form<add_products>(static_cast<SimdLevel>(level))(values, sum);
    EXPECT_EQ(sum, expected) << level;
  }
}

TEST(Simd, EveryLevelHasAFormOfItsOwn) {
#ifdef __x86_64__
  if (best_simd_level() != SimdLevel::kAvx512) GTEST_SKIP() << "not all levels";
  EXPECT_NE(simd_form<add_products>(SimdLevel::kBaseline), simd_form<add_products>(SimdLevel::kAvx2));
  EXPECT_NE(simd_form<add_products>(SimdLevel::kAvx2), simd_form<add_products>(SimdLevel::kAvx512));
#endif
}

}  // namespace
}  // namespace quorum
