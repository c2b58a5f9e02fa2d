#include "engine/core/simd.h"

#include "engine/core/check.h"

namespace quorum {

SimdLevel best_simd_level() {
#ifdef __x86_64__
  // Each name stands for all features of the level.
  if (__builtin_cpu_supports("x86-64-v4")) return SimdLevel::kAvx512;
  if (__builtin_cpu_supports("x86-64-v3")) return SimdLevel::kAvx2;
#endif
  return SimdLevel::kBaseline;
}

bool has_avx512_vnni() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512vnni") != 0;
#else
  return false;
#endif
}

void check_simd_level(SimdLevel simd) { QUORUM_CHECK_LE(static_cast<int>(simd), static_cast<int>(best_simd_level())); }

}  // namespace quorum
