// Normalized cross-correlation of two windows from exact sums (the paper, appendix A).
#pragma once

#include <cstdint>

namespace quorum {

/// Sums over the samples of a window in the reference (a) and in a neighbor (b). Integers, so any order gives the same.
struct WindowSums {
  std::int32_t a[3] = {};  ///< of a, per channel
  std::int32_t b[3] = {};  ///< of b, per channel
  std::int32_t aa = 0;     ///< of a * a, all channels
  std::int32_t bb = 0;     ///< of b * b, all channels
  std::int32_t ab = 0;     ///< of a * b, all channels
};

/// Normalized cross-correlation with a mean per channel, -1..1; 0 if either window is flat.
/// sums: of n = m * m samples a channel, as sample_bilinear gives them. Cannot fail. Source: the paper, appendix A.
/// Twin: ncc_from_sums in shaders/lib/ncc_from_sums.glsl.
float ncc_from_sums(const WindowSums& sums, int n);

}  // namespace quorum
