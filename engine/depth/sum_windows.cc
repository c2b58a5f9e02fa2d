#include "engine/depth/sum_windows.h"

#include <algorithm>
#include <cstring>

#ifdef __x86_64__
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 finds it in its own header
#endif
#include <immintrin.h>
#endif

#include "shaders/layout.h"

namespace quorum {
namespace {

using Order = std::array<std::uint8_t, WindowLanes::kGroup>;

/// For any processor: loops over 16-bit words that compilers vectorize, with AVX-512's, NEON's or no instructions.
namespace portable {

constexpr int kWords = 4 * WindowLanes::kGroup;  // of a group: red, green, blue and 0 of each lane

struct Group {
  alignas(64) std::int16_t left[kWords], right[kWords];  // columns: texel, and in the low byte the one below
  alignas(64) std::int16_t fraction_x[kWords], fraction_y[kWords];
  alignas(64) std::int32_t b[kWords], bb[kWords], ab[kWords];
};

void read_columns(const TexelColumns& neighbor, const WindowLanes& lanes, std::size_t first, int dx, int dy,
                  Group& group) {
  for (std::size_t i = 0; i < WindowLanes::kGroup; ++i) {
    constexpr int kRest = kPlacementBits - kPositionBits;
    constexpr std::uint64_t kFourTimes = 0x0001'0001'0001'0001U;
    const std::size_t lane = first + i;
    const int u = (lanes.u[lane] + (dx * lanes.u_x[lane] + dy * lanes.u_y[lane])) >> kRest;
    const int v = (lanes.v[lane] + (dx * lanes.v_x[lane] + dy * lanes.v_y[lane])) >> kRest;
    const std::uint64_t* entry =
        neighbor.entries.data() + (v >> kPositionBits) * neighbor.stride + (u >> kPositionBits);
    const std::uint64_t x = static_cast<std::uint64_t>(u & (kPositionScale - 1)) * kFourTimes;
    const std::uint64_t y = static_cast<std::uint64_t>(v & (kPositionScale - 1)) * kFourTimes;
    std::memcpy(group.left + 4 * i, entry, sizeof(*entry));
    std::memcpy(group.right + 4 * i, entry + 1, sizeof(*entry));
    std::memcpy(group.fraction_x + 4 * i, &x, sizeof(x));
    std::memcpy(group.fraction_y + 4 * i, &y, sizeof(y));
  }
}

void add_samples(const WindowLanes::Place& place, int shift, Group& group) {
  alignas(64) std::int16_t reference[kWords];
  std::memcpy(reference, place.samples, sizeof(reference));
  alignas(64) std::int16_t belongs[kWords];
  for (int i = 0; i < kWords; i += 4)
    for (int k = 0; k < 4; ++k) belongs[i + k] = reference[i + 3];
  for (int i = 0; i < kWords; ++i) {
    const auto along_y = [&](std::int16_t column) {
      const std::int32_t texel = column >> 8;
      const std::int32_t below = static_cast<std::int16_t>(column * 256) >> 8;
      return static_cast<std::int16_t>(256 * texel + group.fraction_y[i] * (below - texel));
    };
    const std::int32_t left = along_y(group.left[i]);
    const std::int32_t right = along_y(group.right[i]);
    const std::int32_t interpolated = left * (256 - group.fraction_x[i]) + right * group.fraction_x[i];
    const auto b = static_cast<std::int16_t>((interpolated >> shift) & belongs[i]);
    group.b[i] += b;
    group.bb[i] += b * b;
    group.ab[i] += reference[i] * b;
  }
}

void sum(const TexelColumns& neighbor, int count, int shift, WindowLanes& lanes) {
  const int radius = lanes.window / 2;
  const WindowLanes::Place* place = lanes.reference.data();
  for (std::size_t first = 0; first < static_cast<std::size_t>(count); first += WindowLanes::kGroup) {
    Group group = {};
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        read_columns(neighbor, lanes, first, dx, dy, group);
        add_samples(*place++, shift, group);
      }
    }
    for (std::size_t i = 0; i < WindowLanes::kGroup; ++i) {
      for (std::size_t channel = 0; channel < 3; ++channel) lanes.b[channel][first + i] = group.b[4 * i + channel];
      lanes.bb[first + i] = group.bb[4 * i] + group.bb[4 * i + 1] + group.bb[4 * i + 2];
      lanes.ab[first + i] = group.ab[4 * i] + group.ab[4 * i + 1] + group.ab[4 * i + 2];
    }
  }
}

constexpr Order kOrder = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

}  // namespace portable

#ifdef __x86_64__

/// The lane whose samples stand at each place: those of lanes 4 n to 4 n + 3 in the n-th 128 bits of two vectors.
constexpr Order kPacked = {0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15};

namespace avx2 {

#define QUORUM_TARGET gnu::target(QUORUM_AVX2)
[[QUORUM_TARGET, gnu::always_inline]] inline __m256i add_products(__m256i sum, __m256i a, __m256i b) {
  return _mm256_add_epi32(sum, _mm256_madd_epi16(a, b));
}
#include "engine/depth/sum_windows_form.h"
#undef QUORUM_TARGET

}  // namespace avx2

namespace vnni {

#define QUORUM_TARGET gnu::target(QUORUM_AVX512_VNNI)
[[QUORUM_TARGET, gnu::always_inline]] inline __m256i add_products(__m256i sum, __m256i a, __m256i b) {
  return _mm256_dpwssd_epi32(sum, a, b);
}
#include "engine/depth/sum_windows_form.h"
#undef QUORUM_TARGET

}  // namespace vnni

#endif

}  // namespace

WindowSumForm window_sum_form(SimdLevel simd) {
  const WindowSumForm form{portable::kOrder, portable::sum};
#ifdef __x86_64__
  return simd_choice(simd, form, WindowSumForm{kPacked, avx2::sum}, WindowSumForm{kPacked, vnni::sum});
#else
  return simd_choice(simd, form, form, form);
#endif
}

RowSampler row_sampler(SimdLevel simd) {
#ifdef __x86_64__
  return simd_choice<RowSampler>(simd, nullptr, avx2::sample, vnni::sample);
#else
  return simd_choice<RowSampler>(simd, nullptr, nullptr, nullptr);
#endif
}

}  // namespace quorum
