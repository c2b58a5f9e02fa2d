// Maps as pictures to look at.
#pragma once

#include <Eigen/Core>

#include "engine/core/grid.h"
#include "engine/image/image.h"

namespace quorum {

/// A depth map in the colors of "Turbo" (Mikhailov 2019): blue for near to red for far, between the 1st and the 99th
/// percentile of the depths, beyond them as at them. Black where there is no depth (0, negative or not finite). Empty
/// for an empty map.
ColorImage color_map_depth(const Grid<float>& depth);

/// A map of values from 0 (black) to 1 (white) in gray, as in the paper's figure 2. Values outside are clamped; what is
/// not a number is black. Empty for an empty map.
ColorImage color_map_unit(const Grid<float>& map);

/// Unit normals in the camera frame: red to the right, green up, blue toward the camera, each from -1 (black) to 1.
/// Black where there is none. Empty for an empty map.
ColorImage color_map_normal(const Grid<Eigen::Vector3f>& normals);

}  // namespace quorum
