// Normalized cross-correlation of two windows from exact sums (the paper, appendix A).
#pragma once

#include <cstdint>

#include "engine/image/padded_image.h"

namespace quorum {

/// Sums over the samples of a window in the reference (a) and in a neighbor (b). Integers, so any order gives the same.
struct WindowSums {
  std::int32_t a[3] = {};  ///< of a, per channel
  std::int32_t b[3] = {};  ///< of b, per channel
  std::int32_t aa = 0;     ///< of a * a, all channels
  std::int32_t bb = 0;     ///< of b * b, all channels
  std::int32_t ab = 0;     ///< of a * b, all channels
};

/// Adds a sample of the reference and its counterpart in the neighbor.
inline void add_sample(WindowSums& sums, const Sample& a, const Sample& b) {
  sums.a[0] += a.red, sums.a[1] += a.green, sums.a[2] += a.blue;
  sums.b[0] += b.red, sums.b[1] += b.green, sums.b[2] += b.blue;
  sums.aa += a.red * a.red + a.green * a.green + a.blue * a.blue;
  sums.bb += b.red * b.red + b.green * b.green + b.blue * b.blue;
  sums.ab += a.red * b.red + a.green * b.green + a.blue * b.blue;
}

/// Normalized cross-correlation with a mean per channel, -1..1; 0 if either window is flat.
/// sums: of n = m * m samples a channel, as sample_bilinear gives them. Cannot fail. Source: the paper, appendix A.
/// Twin: ncc_from_sums in shaders/lib/ncc_from_sums.glsl.
float ncc_from_sums(const WindowSums& sums, int n);

}  // namespace quorum
