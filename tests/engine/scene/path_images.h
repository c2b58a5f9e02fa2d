// What the cameras of camera_paths.h see: surfaces with a texture of waves.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/image/image.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The point that a ray meets; the ray reaches depth 1 from the origin.
using Surface = std::function<Eigen::Vector3d(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray)>;

/// The plane z = 0.
inline Eigen::Vector3d on_ground(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  return origin - origin.z() / ray.z() * ray;
}

/// The walls, floor and ceiling of a room from -3 to 3.
inline Eigen::Vector3d on_walls(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis)
    if (ray(axis) != 0.0) nearest = std::min(nearest, ((ray(axis) > 0 ? 3.0 : -3.0) - origin(axis)) / ray(axis));
  return origin + nearest * ray;
}

/// The shortest wave has a length of 0.35.
inline Rgba wave_color(const Eigen::Vector3d& point) {
  const auto level = [&](double phase) {
    double sum = 0.0;
    for (const double f : {2.1, 4.7, 9.3, 17.9})
      sum += std::sin(f * point.x() + phase) * std::cos(0.8 * f * point.y() + 1.3 * phase + f) +
             std::sin(0.9 * f * point.z() - phase);
    return static_cast<std::uint32_t>(std::clamp(128 + 22 * sum, 0.0, 255.0));
  };
  return make_rgb(level(0.0), level(1.1), level(2.7));
}

/// fineness: of the texture; 2 halves its waves.
inline ColorImage image_of(const View& view, const Surface& surface, double fineness = 1.0) {
  const Eigen::Vector3d origin = view.camera.center();
  ColorImage image(view.width, view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      image.at(x, y) = wave_color(fineness * surface(origin, view.camera.unproject(x, y, 1.0) - origin));
  return image;
}

/// The first cameras of a path with images of 160 x 120 pixels.
inline Scene small_images(Scene scene, std::size_t count = 100) {
  scene.views.resize(std::min(count, scene.views.size()));
  for (View& view : scene.views) {
    view.width /= 2;
    view.height /= 2;
    view.camera.intrinsics.topRows(2) *= 0.5;
  }
  return scene;
}

}  // namespace quorum
