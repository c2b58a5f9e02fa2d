// The parts of reference windows that look like their centers: what lies behind or before an edge seldom has the colors
// of this side, and would pull the window off the surface (beyond the paper, whose windows are whole; known as adaptive
// support: Yoon and Kweon 2006). A pixel belongs to the part or not, so all sums stay exact.
// Twin: shaders/support_windows.comp.
#pragma once

#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

/// What NCC needs of each window of a photograph; all 0 where the window sticks out. window: side, pixels. tolerance:
/// by how much a pixel's channels may differ from the center's, 0..255; where fewer than 9 of 25 pixels are as alike,
/// it rises until so many are. 255 keeps whole windows. Cannot fail.
Grid<SupportWindow> make_support_windows(const PaddedImage& image, int window, int tolerance,
                                         SimdLevel simd = best_simd_level());

}  // namespace quorum
