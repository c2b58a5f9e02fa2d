// A textured sphere seen by a few cameras: an input whose depth is known in closed form.
#pragma once

#include <memory>
#include <vector>

#include "engine/depth/sweep_task.h"
#include "engine/image/image.h"
#include "engine/scene/scene.h"

namespace quorum {

constexpr double kSphereRadius = 1.0;  // at the origin, scene units

struct SphereScene {
  Scene scene;
  std::vector<ColorImage> images;
};

/// views cameras on an arc, 12 degrees apart, 4 units from the center; every second one is upside down if flip is set.
/// The texture is smooth and seeded; the background is black.
SphereScene make_sphere_scene(int views, int width, int height, bool flip, unsigned seed);

/// Cameras on a full circle, 4 units from the center, and one above and one below, all upright. As above otherwise.
SphereScene make_surrounding_sphere_scene(int around, int width, int height, unsigned seed);

/// As make_sphere_scene, all upright, with a texture that the noise of the photographs nearly hides.
SphereScene make_weak_sphere_scene(int views, int width, int height, unsigned seed);

/// Depth of the sphere at a pixel of a view, 0 where the ray misses it.
double sphere_depth(const View& view, double x, double y);

/// The sweep of one view against all others.
SweepTask make_sphere_task(const SphereScene& sphere, int reference, const SweepOptions& options);

}  // namespace quorum
