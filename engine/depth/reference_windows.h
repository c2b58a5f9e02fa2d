// What NCC needs of the windows of a reference view, once for all planes and neighbors.
#pragma once

#include "engine/core/grid.h"
#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

/// Sums and inverse deviation of the window around each pixel. window: its side, odd, 3 to 15 pixels. Windows that
/// reach over the border of the image are left at 0; no pixel tests a plane there. Twin: ncc_from_sums, of which it is
/// a part.
Grid<ReferenceWindow> make_reference_windows(const PaddedImage& image, int window);

}  // namespace quorum
