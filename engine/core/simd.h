// Which vector instructions the CPU's stages use. A stage is written once, compiled for each level, and chosen at run
// time: here alone.
#pragma once

#include <bit>
#include <cstdint>

namespace quorum {

/// Instructions that a stage may use: those of the plain processor, x86-64-v3, x86-64-v4. All give the same bytes.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// The most that this processor and its operating system have.
SimdLevel best_simd_level();

/// True if it also multiplies and adds pairs of 16-bit words at once, as AVX-512 does with VNNI.
bool has_avx512_vnni();

/// Stops the program if the processor does not have the level.
void check_simd_level(SimdLevel simd);

#define QUORUM_AVX2 "arch=x86-64-v3"
// x86-64-v4 with vectors of 512 bits. clang does not know the preference in an attribute, ignores the whole attribute
// for it, and prefers 256 bits under the name x86-64-v4; with the features themselves it does not.
#ifdef __clang__
#define QUORUM_AVX512 "arch=x86-64-v3,avx512f,avx512bw,avx512cd,avx512dq,avx512vl"
#else
#define QUORUM_AVX512 "arch=x86-64-v4,prefer-vector-width=512"
#endif

#define QUORUM_AVX512_VNNI QUORUM_AVX512 ",avx512vnni"

/// The forms of a function, one for each level. kBody is always_inline, and so is what it calls.
template <auto kBody>
struct SimdForms;

template <typename Result, typename... Args, Result (*kBody)(Args...)>
struct SimdForms<kBody> {
  static Result baseline(Args... args) { return kBody(args...); }
#ifdef __x86_64__
  [[gnu::target(QUORUM_AVX2)]] static Result avx2(Args... args) { return kBody(args...); }
  [[gnu::target(QUORUM_AVX512)]] static Result avx512(Args... args) { return kBody(args...); }
#endif
};

/// The form of kBody for a level that the processor has: simd_form<sweep_tile_body<5>>(simd)(arguments).
template <auto kBody>
auto simd_form(SimdLevel simd) {
  check_simd_level(simd);
#ifdef __x86_64__
  if (simd == SimdLevel::kAvx512) return &SimdForms<kBody>::avx512;
  if (simd == SimdLevel::kAvx2) return &SimdForms<kBody>::avx2;
#endif
  return &SimdForms<kBody>::baseline;
}

/// Of forms that are written apart, the one for a level that the processor has.
template <typename Form>
Form simd_choice(SimdLevel simd, Form baseline, Form avx2, Form avx512_vnni) {
  check_simd_level(simd);
  if (simd == SimdLevel::kAvx512 && has_avx512_vnni()) return avx512_vnni;
  return simd == SimdLevel::kBaseline ? baseline : avx2;
}

/// The value, or 0 if it is not wanted; by bits, since the compiler turns a choice into a branch and gives up vectors.
[[gnu::always_inline]] inline float kept_if(bool wanted, float value) {
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(value) & -static_cast<std::int32_t>(wanted));
}

}  // namespace quorum
