// Float operations that give the same bits on every device. Vulkan rounds + - * correctly but not division and square
// root, so these two are built from a bit-pattern estimate and Newton steps.
// Twin: shaders/lib/exact.glsl. Same names, same order of operations.
#pragma once

#include <bit>
#include <cstdint>

namespace quorum {

/// 1 / x within 2 units in the last place. x: positive, normal, 1e-30 to 1e30.
[[gnu::always_inline]] inline float reciprocal(float x) {
  float y = std::bit_cast<float>(0x7ef311c7U - std::bit_cast<std::uint32_t>(x));
  y = y * (2.0F - x * y);
  y = y * (2.0F - x * y);
  y = y * (2.0F - x * y);
  return y;
}

/// 1 / sqrt(x) within 3 units in the last place. x: positive, normal, 1e-30 to 1e30.
[[gnu::always_inline]] inline float reciprocal_sqrt(float x) {
  const float half = 0.5F * x;
  float y = std::bit_cast<float>(0x5f3759dfU - (std::bit_cast<std::uint32_t>(x) >> 1));
  y = y * (1.5F - (half * y) * y);
  y = y * (1.5F - (half * y) * y);
  y = y * (1.5F - (half * y) * y);
  return y;
}

/// The 24 leading bits of an integer, toward zero, as float. value: an integer of magnitude below 2^53, held in a
/// double, where vector units convert it from int and multiply it exactly.
[[gnu::always_inline]] inline float float_from_integer(double value) {
  constexpr std::uint64_t kDroppedBits = (1ULL << 29) - 1;  // a double has 52 fraction bits, a float 23
  return static_cast<float>(std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & ~kDroppedBits));
}

}  // namespace quorum
