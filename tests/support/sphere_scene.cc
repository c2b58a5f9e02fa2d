#include "tests/support/sphere_scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/core/check.h"
#include "engine/depth/plane_moves.h"
#include "engine/depth/plane_warp.h"

namespace quorum {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A sum of waves in space, 0..1, a different one per channel.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (auto& channel : waves_)
      for (auto& wave : channel)
        wave = {18.0 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random)), 3.0 * uniform(random)};
  }
  [[nodiscard]] double value(std::size_t channel, const Eigen::Vector3d& point) const {
    double sum = 0.0;
    for (const auto& [frequency, phase] : waves_[channel]) sum += std::sin(frequency.dot(point) + phase);
    return 0.5 + 0.09 * sum;
  }

 private:
  std::array<std::array<std::pair<Eigen::Vector3d, double>, 8>, 3> waves_;
};

/// A view that looks at the origin; up: a world direction, toward the top of the image.
View look_at_origin(int index, const Eigen::Vector3d& center, const Eigen::Vector3d& up, int width, int height) {
  const Eigen::Vector3d forward = -center.normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  const Eigen::Vector3d down = forward.cross(right);
  View view;
  view.name = fmt::format("sphere{:02}", index);
  view.width = width;
  view.height = height;
  view.camera.camera_from_world << right.transpose(), down.transpose(), forward.transpose();
  view.camera.translation = -view.camera.camera_from_world * center;
  view.camera.intrinsics << 1.4 * width, 0, (width - 1) / 2.0, 0, 1.41 * width, (height - 1) / 2.0, 0, 0, 1;
  return view;
}

void add_view(SphereScene& sphere, const Texture& texture, const View& view) {
  ColorImage image(view.width, view.height, make_rgb(0, 0, 0));
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double depth = sphere_depth(view, x, y);
      if (depth <= 0) continue;
      const Eigen::Vector3d point = view.camera.unproject(x, y, depth);
      const auto channel = [&](std::size_t c) {
        return static_cast<std::uint32_t>(std::clamp(255.0 * texture.value(c, point), 0.0, 255.0));
      };
      image.at(x, y) = make_rgb(channel(0), channel(1), channel(2));
    }
  }
  sphere.scene.views.push_back(view);
  sphere.images.push_back(std::move(image));
}

SphereScene empty_sphere_scene() {
  SphereScene sphere;
  sphere.scene.bounds = {{-1.05, -1.05, -1.05}, {1.05, 1.05, 1.05}};
  return sphere;
}

}  // namespace

SphereScene make_weak_sphere_scene(int views, int width, int height, unsigned seed) {
  SphereScene sphere = make_sphere_scene(views, width, height, false, seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> noise(-5, 5);
  for (ColorImage& image : sphere.images) {
    for (Rgba& pixel : image.values) {
      const auto weak = [&](std::uint32_t value) {
        return static_cast<std::uint32_t>(100 + static_cast<int>(value) / 6 + noise(random));
      };
      pixel = make_rgb(weak(red_of(pixel)), weak(green_of(pixel)), weak(blue_of(pixel)));
    }
  }
  return sphere;
}

double sphere_depth(const View& view, double x, double y) {
  const Eigen::Vector3d origin = view.camera.center();
  const Eigen::Vector3d ray = view.camera.unproject(x, y, 1.0) - origin;
  const double a = ray.squaredNorm();
  const double b = origin.dot(ray);
  const double discriminant = b * b - a * (origin.squaredNorm() - kSphereRadius * kSphereRadius);
  return discriminant <= 0 ? 0.0 : (-b - std::sqrt(discriminant)) / a;
}

SphereScene make_sphere_scene(int views, int width, int height, bool flip, unsigned seed) {
  const Texture texture(seed);
  SphereScene sphere = empty_sphere_scene();
  for (int index = 0; index < views; ++index) {
    const double angle = 12.0 * kDegree * (index - (views - 1) / 2.0);
    const Eigen::Vector3d center = 4.0 * Eigen::Vector3d(std::sin(angle), 0.15, -std::cos(angle)).normalized();
    const Eigen::Vector3d up(0, flip && index % 2 == 1 ? -1 : 1, 0);
    add_view(sphere, texture, look_at_origin(index, center, up, width, height));
  }
  return sphere;
}

SphereScene make_surrounding_sphere_scene(int around, int width, int height, unsigned seed) {
  const Texture texture(seed);
  SphereScene sphere = empty_sphere_scene();
  for (int index = 0; index < around; ++index) {
    const double angle = 360.0 * kDegree * index / around;
    const Eigen::Vector3d center(4.0 * std::sin(angle), 0, -4.0 * std::cos(angle));
    add_view(sphere, texture, look_at_origin(index, center, {0, -1, 0}, width, height));
  }
  for (const double y : {-4.0, 4.0})
    add_view(sphere, texture,
             look_at_origin(static_cast<int>(sphere.images.size()), {0, y, 0}, {0, 0, 1}, width, height));
  return sphere;
}

SweepTask make_sphere_task(const SphereScene& sphere, int reference, const SweepOptions& options) {
  std::vector<int> neighbors;
  for (int view = 0; view < static_cast<int>(sphere.images.size()); ++view)
    if (view != reference) neighbors.push_back(view);
  SweepTask task;
  task.options = options;
  auto planes = make_depth_planes(sphere.scene, reference, neighbors, options);
  QUORUM_CHECK_EQ(planes.has_value(), true);
  task.planes = std::move(*planes);
  const View& view = sphere.scene.views[static_cast<std::size_t>(reference)];
  task.intrinsics = view.camera.intrinsics;
  task.max_tilt = max_plane_tilt(view.camera);
  task.ranges = make_plane_ranges(view, sphere.scene.bounds, {}, task.planes, options.window / 2);
  const auto padded = [&](int index) {
    return std::make_shared<const PaddedImage>(pad_image(sphere.images[static_cast<std::size_t>(index)]));
  };
  task.reference = padded(reference);
  for (const int neighbor : neighbors) {
    task.neighbors.push_back(padded(neighbor));
    task.warps.push_back(make_plane_warp(view.camera, sphere.scene.views[static_cast<std::size_t>(neighbor)].camera));
  }
  return task;
}

}  // namespace quorum
