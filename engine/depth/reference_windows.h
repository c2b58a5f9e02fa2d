// What NCC needs of the windows of a reference view, once for all planes and neighbors.
// Twin: shaders/lib/reference_windows.glsl, shaders/reference_windows.comp.
#pragma once

#include "engine/core/grid.h"
#include "engine/depth/ncc_from_sums.h"
#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

/// Sums over samples of a window in the reference.
struct ReferenceSums {
  std::int32_t sum[3] = {};  ///< per channel
  std::int32_t squares = 0;  ///< all channels
};

[[gnu::always_inline]] inline void add_sample(ReferenceSums& sums, const Sample& a) {
  sums.sum[0] += a.red, sums.sum[1] += a.green, sums.sum[2] += a.blue;
  sums.squares += product(a, a);
}

/// The window that has these sums over n samples a channel.
[[gnu::always_inline]] inline ReferenceWindow window_from_sums(const ReferenceSums& sums, int n) {
  const float variance = scaled_covariance(n, sums.squares, sums.sum, sums.sum);
  return {{sums.sum[0], sums.sum[1], sums.sum[2]}, reciprocal_sqrt(variance)};
}

/// Sums and inverse deviation of the window around each pixel. window: its side, odd, 3 to 15 pixels. Windows that
/// reach over the border of the image are left at 0; no pixel tests a plane there.
Grid<ReferenceWindow> make_reference_windows(const PaddedImage& image, int window);

}  // namespace quorum
