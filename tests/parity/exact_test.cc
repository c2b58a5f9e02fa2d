#include "engine/core/exact.h"

#include <cmath>
#include <random>

#include "tests/parity/parity_test.h"

namespace quorum {
namespace {

struct ProbeInput {
  float x;
  std::int32_t a;
  std::int32_t b;
  std::int32_t c;
};

struct ProbeOutput {
  float reciprocal;
  float reciprocal_sqrt;
  float product;
  float difference;
};

class ExactParity : public ParityTest {};

TEST_F(ExactParity, SeededValuesGiveTheBitsOfTheTwin) {
  constexpr std::uint32_t kCount = 100000;
  std::mt19937 random(1);
  const auto integer = [&] {  // of any number of bits up to 26, of any sign
    const auto magnitude = static_cast<std::int32_t>(random() >> (6 + random() % 26));
    return random() % 2 == 0 ? magnitude : -magnitude;
  };
  std::vector<ProbeInput> input(kCount);
  for (ProbeInput& value : input) {
    const double exponent = std::uniform_real_distribution<double>(-29.9, 29.9)(random);
    value = {static_cast<float>(std::pow(10.0, exponent)), integer(), integer(), integer()};
  }
  input[0] = {1.0F, 0, 0, 0};
  input[1] = {4.0F, 1, -1, 1};
  input[2] = {0.25F, (1 << 26) - 1, (1 << 26) - 1, 0};
  input[3] = {3.0F, 1 << 12, 1 << 12, 1};  // 2^24 - 1 and 2^24: where the dropped bits begin
  input[4] = {3.0F, 65536, 65536, 1};      // 2^32: the low word is 0
  input[5] = {3.0F, 65536, -65536, 0};
  input[6] = {3.0F, -32768, 32768, 0};
  std::vector<ProbeOutput> twin(kCount);
  int wide = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const ProbeInput& value = input[i];
    const std::int64_t product = std::int64_t{value.a} * value.b;
    const std::int64_t difference = product - std::int64_t{value.c} * value.c;
    wide += std::abs(difference) >> 32 != 0 ? 1 : 0;
    twin[i] = {reciprocal(value.x), reciprocal_sqrt(value.x), float_from_integer(static_cast<double>(product)),
               float_from_integer(static_cast<double>(difference))};
  }
  expect_share(wide, kCount, 0.2, 0.8, "integers of more than 32 bits");
  const Buffer results = buffer_of(std::vector<ProbeOutput>(kCount));
  run(test_kernel("exact_probe"), {kCount}, kCount, {buffer_of(input), results});
  same_words(content<ProbeOutput>(results), twin, 1, "words: reciprocal, reciprocal_sqrt, product, difference; value");
}

}  // namespace
}  // namespace quorum
