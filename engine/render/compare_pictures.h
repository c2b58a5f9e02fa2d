// How like two pictures are.
#pragma once

#include <cstdint>

#include "engine/image/image.h"

namespace quorum {

struct PictureLikeness {
  std::uint64_t pixels = 0;  ///< that were compared
  double psnr = 0;           ///< peak signal to noise ratio of all channels, dB; 99 for equal ones
  double ssim = 0;           ///< structural similarity of brightness, at most 1; 0 where no window fits
};

/// Compares two pictures of one size where the mask, of that size, is not 0. SSIM (Wang, Bovik, Sheikh, Simoncelli
/// 2004) with square windows of 7 pixels without weights, those of which all pixels are compared. Cannot fail.
PictureLikeness compare_pictures(const ColorImage& a, const ColorImage& b, const Mask& where);

}  // namespace quorum
