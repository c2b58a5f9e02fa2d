// Inputs of the kernels that refine planes.
#pragma once

#include <random>
#include <vector>

#include "engine/depth/plane_moves.h"
#include "engine/depth/score_planes.h"
#include "engine/depth/vote_depth.h"
#include "tests/parity/parity_test.h"
#include "tests/support/sphere_scene.h"

namespace quorum {

/// Planes near those of a fronto-parallel sweep; every fifth pixel has none.
inline PixelPlane random_pixel_plane(std::mt19937& random, const SweepTask& task, std::size_t pixel) {
  const PlaneRange& range = task.ranges.values[pixel];
  if (range.first > range.last || random() % 5 == 0) return kNoPlane;
  std::normal_distribution<float> noise(0.0F, 1.0F);
  const std::uint32_t plane = range.first + static_cast<std::uint32_t>(random()) % (range.last - range.first + 1);
  const float inverse_depth = task.planes.inverse_depth[plane];
  return {inverse_depth * (1.0F + 1e-3F * noise(random)),
          4e-3F * inverse_depth * noise(random),
          4e-3F * inverse_depth * noise(random),
          0.7F,
          std::uniform_real_distribution<float>(0.0F, 1.0F)(random),
          static_cast<int>(random() % 2)};
}

inline Grid<PixelPlane> random_planes(std::mt19937& random, const SweepTask& task) {
  Grid<PixelPlane> planes(task.ranges.width, task.ranges.height, kNoPlane);
  for (std::size_t pixel = 0; pixel < planes.values.size(); ++pixel)
    planes.values[pixel] = random_pixel_plane(random, task, pixel);
  return planes;
}

}  // namespace quorum
