// Maps as pictures to look at.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "engine/core/grid.h"
#include "engine/image/image.h"

namespace quorum {

/// A depth map in the colors of "Turbo" (Mikhailov 2019): blue for near to red for far, between the 1st and the 99th
/// percentile of the depths, beyond them as at them. Black where there is no depth (0, negative or not finite). Empty
/// for an empty map.
ColorImage color_map_depth(const Grid<float>& depth);

/// Every n-th pixel of every n-th row, so that no row has more than `most` pixels. Empty for an empty map.
template <typename Value>
Grid<Value> thin_out(const Grid<Value>& map, int most) {
  if (map.empty()) return map;
  const int step = std::max(1, (map.width + most - 1) / most);
  Grid<Value> thin((map.width + step - 1) / step, (map.height + step - 1) / step, map.values[0]);
  for (int y = 0; y < thin.height; ++y)
    for (int x = 0; x < thin.width; ++x) thin.at(x, y) = map.at(x * step, y * step);
  return thin;
}

/// A map of values from 0 (black) to 1 (white) in gray, as in the paper's figure 2. Values outside are clamped; what is
/// not a number is black. Empty for an empty map.
ColorImage color_map_unit(const Grid<float>& map);

/// Unit normals in the camera frame: red to the right, green up, blue toward the camera, each from -1 (black) to 1.
/// Black where there is none. Empty for an empty map.
ColorImage color_map_normal(const Grid<Eigen::Vector3f>& normals);

}  // namespace quorum
