// Photographs of a lens as pinhole pictures.
#pragma once

#include "engine/camera/pinhole_picture.h"
#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

/// The picture (pinhole_picture) that the lens's photograph shows; bicubic, positions rounded to 1/32 pixel, the border
/// repeated. photograph: of the lens's size. Fails (kMemory) if it does not fit into memory.
Expected<ColorImage> undistort_image(const ColorImage& photograph, const Lens& lens, const PinholePicture& picture);

/// The same for a mask: the nearest pixel of it, and 0 outside.
Expected<Mask> undistort_mask(const Mask& mask, const Lens& lens, const PinholePicture& picture);

}  // namespace quorum
