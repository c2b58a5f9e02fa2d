#include "engine/synthetic/temple.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/option.h"
#include "engine/synthetic/temple_solids.h"

namespace quorum {

namespace {

using Eigen::Vector3d;

/// K of the Middlebury temple, scaled to an image width. Pixel centers are integers, so edges lie at -0.5.
Eigen::Matrix3d intrinsics_for(int width) {
  const double scale = width / 640.0;
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = 1520.4 * scale;
  k(1, 1) = 1525.9 * scale;
  k(0, 2) = (302.32 + 0.5) * scale - 0.5;
  k(1, 2) = (246.87 + 0.5) * scale - 0.5;
  return k;
}

/// Unit vector from the object to a place above the ground plane; azimuth 0 is +z, the front, and grows toward +x.
Vector3d direction_at(double azimuth, double sine_of_elevation) {
  const double level = std::sqrt(1.0 - sine_of_elevation * sine_of_elevation);
  return {level * std::sin(azimuth), sine_of_elevation, level * std::cos(azimuth)};
}

/// Where the camera of a view stands, as seen from the middle of the object, meters.
Vector3d camera_place(const TempleOptions& options, int view) {
  constexpr double kDistance = 0.70;  // all corners of the bounds are in the image, from any side
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (options.path == CameraPath::kRing)
    return kDistance * direction_at(360.0 * kDegree * view / options.views, std::sin(20.0 * kDegree));
  // Equal steps in height with turns by the golden angle spread evenly over the sphere.
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double lowest = std::sin(5.0 * kDegree);
  const double highest = std::sin(75.0 * kDegree);
  const double height = lowest + (highest - lowest) * (view + 0.5) / options.views;
  return kDistance * direction_at(golden_angle * view, height);
}

/// A camera that looks at a target; upside down means turned by 180° about the optical axis.
Camera camera_looking_at(const Vector3d& target, const Vector3d& center, bool upside_down, int width) {
  const Vector3d forward = (target - center).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  const Vector3d down = forward.cross(right);
  const double sense = upside_down ? -1.0 : 1.0;
  Camera camera;
  camera.intrinsics = intrinsics_for(width);
  camera.camera_from_world.row(0) = sense * right.transpose();
  camera.camera_from_world.row(1) = sense * down.transpose();
  camera.camera_from_world.row(2) = forward.transpose();
  camera.translation = -camera.camera_from_world * center;
  return camera;
}

}  // namespace

Expected<void> TempleOptions::check() const {
  struct Range {
    const char* name;
    double value, low, high;
  };
  for (const Range& range :
       {Range{"views", static_cast<double>(views), 3, 1024}, Range{"width", static_cast<double>(width), 64, 8192},
        Range{"noise", noise, 0, 64}, Range{"texture", texture, 0, 4}, Range{"gloss", gloss, 0, 1}}) {
    if (range.value >= range.low && range.value <= range.high) continue;
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give {} to {}", option_name(range.name), range.value, range.low, range.high));
  }
  return {};
}

Scene make_temple_scene(const TempleOptions& options) {
  QUORUM_CHECK_EQ(options.check().has_value(), true);
  Scene scene;
  scene.bounds = temple_bounds();
  const Vector3d target = scene.bounds.center();
  for (int i = 0; i < options.views; ++i) {
    View view;
    view.name = fmt::format("temple{:04}", i + 1);
    view.image_path = view.name + ".png";
    view.width = options.width;
    view.height = options.width * 3 / 4;
    view.camera = camera_looking_at(target, target + camera_place(options, i), i % 3 == 2, options.width);
    scene.views.push_back(std::move(view));
  }
  return scene;
}

}  // namespace quorum
