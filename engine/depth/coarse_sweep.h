// Where the surface is, of views whose cameras alone are known: a plane sweep of small images over all depths that have
// a disparity. After R. T. Collins: A Space-Sweep Approach to True Multi-Image Matching, CVPR 1996.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/padded_image.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Photographs are halved until they are not larger, pixels: disparities of one pixel then span all depths in few
/// planes.
constexpr int kCoarseImageSize = 200;

/// Reads the image of a view, of the size that the scene says.
using ImageReader = std::function<Expected<PaddedImage>(int view)>;

/// Points of the surface, each with the views that found it within two planes of each other. The depths tried go from a
/// disparity of one pixel, between a view and the farthest of the six that it is compared with, up to half an image.
/// Bounds and depth ranges are not asked. Empty where nothing is found, or half of it lies at the farthest
/// depth or beyond: the views are from about one place, or show no texture. Fails as the reader does.
Expected<std::vector<SparsePoint>> coarse_sweep(const Scene& small, const ImageReader& read);

}  // namespace quorum
