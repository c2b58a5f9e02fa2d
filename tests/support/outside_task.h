// The sphere scene (sphere_scene.h) as seen by the coarse sweep beyond the bounds.
#pragma once

#include <vector>

#include "engine/depth/outside_planes.h"
#include "engine/depth/sweep_depth.h"
#include "tests/support/sphere_scene.h"

namespace quorum {

/// Where small images are kept.
inline SmallImages& small_images() {
  static SmallImages images;
  return images;
}

/// The neighbors in the task of make_sphere_task().
inline std::vector<const View*> sphere_neighbors(const SphereScene& sphere, int reference) {
  std::vector<const View*> neighbors;
  for (int view = 0; view < static_cast<int>(sphere.scene.views.size()); ++view)
    if (view != reference) neighbors.push_back(&sphere.scene.views[static_cast<std::size_t>(view)]);
  return neighbors;
}

/// task: of make_sphere_task().
inline SweepTask make_coarse_sphere_task(const SphereScene& sphere, int reference, const SweepTask& task) {
  return make_outside_task(task, sphere.scene.views[static_cast<std::size_t>(reference)],
                           sphere_neighbors(sphere, reference), sphere.scene.bounds, small_images());
}

/// Sets task.outside by the CPU's sweep.
inline void look_outside(const SphereScene& sphere, int reference, SweepTask& task) {
  const SweepTask coarse = make_coarse_sphere_task(sphere, reference, task);
  task.outside = outside_planes(coarse, sweep_depth(coarse, {}),
                                sphere.scene.views[static_cast<std::size_t>(reference)], sphere.scene.bounds);
}

}  // namespace quorum
