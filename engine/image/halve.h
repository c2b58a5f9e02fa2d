// Images of half the size: the levels of a pyramid.
#pragma once

#include "engine/image/image.h"

namespace quorum {

/// floor(width / 2) × floor(height / 2) pixels, each channel the rounded mean of 2 × 2. An odd last column or row is
/// left out. Integers, so the same on every machine.
ColorImage halve_image(const ColorImage& image);

/// The same for a mask: a pixel takes part if all four do.
Mask halve_mask(const Mask& mask);

}  // namespace quorum
