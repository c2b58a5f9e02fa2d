// A camera at the origin that looks along z, and planes before it: inputs of the volume tests.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"

namespace quorum {

/// Its optical axis passes through the center of the image.
inline Camera straight_camera(int width, int height, double focal) {
  Camera camera;
  camera.intrinsics << focal, 0, (width - 1) / 2.0, 0, focal, (height - 1) / 2.0, 0, 0, 1;
  return camera;
}

/// Depth of the plane that crosses the axis at depth and falls away to the right by angle_deg.
inline Grid<float> plane_depth(const Camera& camera, int width, int height, double depth, double angle_deg) {
  const double slope = std::tan(angle_deg * std::numbers::pi / 180.0);
  Grid<float> result(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      result.at(x, y) =
          static_cast<float>(depth / (1.0 - slope * (x - camera.intrinsics(0, 2)) / camera.intrinsics(0, 0)));
  return result;
}

}  // namespace quorum
