// Depth maps for the kernels of the volume: the sphere's exact depth, with noise, holes, cliffs and outliers.
#pragma once

#include <cmath>
#include <random>

#include "engine/volume/range_surface.h"
#include "tests/support/sphere_scene.h"

namespace quorum {

/// A map of a view of the sphere; seeded. outliers: one pixel in so many is anything between 0.01 and 1e6; 0 = none.
inline DepthMap noisy_sphere_map(const View& view, unsigned seed, unsigned outliers) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  DepthMap map;
  map.depth = map.correlation = map.confidence = Grid<float>(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      double depth = sphere_depth(view, x, y);
      if (depth > 0 && random() % 3 == 0) depth += uniform(-0.03, 0.03);
      if (random() % 31 == 0) depth = 0.0;
      if (outliers > 0 && random() % outliers == 0) depth = std::pow(10.0, uniform(-2.0, 6.0));
      if (depth <= 0) continue;
      map.depth.at(x, y) = static_cast<float>(depth);
      map.confidence.at(x, y) = static_cast<float>(uniform(0.0, 1.0));
      map.correlation.at(x, y) = 1.0F;
    }
  }
  return map;
}

}  // namespace quorum
