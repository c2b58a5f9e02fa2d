// The photographs of the temple: rays cast at the exact solids, four a pixel, under three lights with shadows.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>

#include "engine/core/check.h"
#include "engine/synthetic/hash.h"
#include "engine/synthetic/stone_texture.h"
#include "engine/synthetic/temple.h"
#include "engine/synthetic/temple_solids.h"

namespace quorum {

namespace {

using Eigen::Vector3d;

struct Light {
  Vector3d toward;   ///< unit vector from the object to the light
  double intensity;  ///< irradiance of a face turned to it
};

using Lights = std::array<Light, 3>;

/// From the right of the front, from behind on the right, and from the left.
Lights fixed_lights() {
  return {{{Vector3d(0.44, 0.64, 0.63).normalized(), 0.80},
           {Vector3d(0.21, 0.57, -0.79).normalized(), 0.60},
           {Vector3d(-0.85, 0.50, 0.15).normalized(), 0.60}}};
}

/// The lights of one view. Per view, each of the fixed ones is turned about the vertical by up to 60 degrees and
/// changed in strength by up to two fifths.
Lights lights_of_view(const TempleOptions& options, std::uint64_t view_key) {
  constexpr double kTurn = 60.0 * std::numbers::pi / 180.0;
  constexpr double kChange = 0.4;
  Lights lights = fixed_lights();
  if (options.lighting == Lighting::kFixed) return lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto uniform = [&](std::uint64_t salt) {
      return static_cast<double>(mix(view_key ^ mix(2 * i + salt)) >> 11) * 0x1p-52 - 1.0;
    };
    lights[i].toward = Eigen::AngleAxisd(kTurn * uniform(1), Vector3d::UnitY()) * lights[i].toward;
    lights[i].intensity *= 1.0 + kChange * uniform(2);
  }
  return lights;
}

/// Blinn's highlight of a light, 0 to 1 (J. F. Blinn, Models of light reflection, 1977), with exponent 8.
double highlight(const Vector3d& normal, const Vector3d& to_light, const Vector3d& to_camera) {
  double cosine = std::max(0.0, normal.dot((to_light + to_camera).normalized()));
  for (int doubling = 0; doubling < 3; ++doubling) cosine *= cosine;
  return cosine;
}

struct SurfacePoint {
  Vector3d position;
  Vector3d normal;
};

std::optional<SurfacePoint> nearest_surface(const Ray& ray) {
  std::optional<Hit> nearest;
  for (const Solid& solid : temple_solids()) {
    const std::optional<Hit> hit = intersect(solid, ray);
    if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
  }
  if (!nearest) return std::nullopt;
  return SurfacePoint{ray.origin + nearest->t * ray.direction, nearest->normal};
}

bool in_shadow(const SurfacePoint& point, const Light& light) {
  constexpr double kClearance = 1e-7;
  const Ray ray{point.position + kClearance * point.normal, light.toward};
  return std::ranges::any_of(temple_solids(), [&](const Solid& solid) { return intersect(solid, ray).has_value(); });
}

/// Linear color of what a ray sees, 1 = white; Lambert's law, and white highlights on glossy stone.
Vector3d radiance(const Ray& ray, const Lights& lights, const TempleOptions& options) {
  constexpr double kAmbient = 0.40;
  const std::optional<SurfacePoint> point = nearest_surface(ray);
  if (!point) return Vector3d::Zero();
  double irradiance = kAmbient;
  double shine = 0.0;
  for (const Light& light : lights) {
    const double cosine = point->normal.dot(light.toward);
    if (cosine <= 0 || in_shadow(*point, light)) continue;
    irradiance += light.intensity * cosine;
    if (options.gloss > 0)
      shine += light.intensity * highlight(point->normal, light.toward, -ray.direction.normalized());
  }
  return irradiance * stone_reflectance(point->position, options.texture, options.seed) +
         Vector3d::Constant(options.gloss * shine);
}

/// The rays through the pixels of a view.
class RayMaker {
 public:
  explicit RayMaker(const Camera& camera)
      : center_(camera.center()),
        world_from_pixel_(camera.camera_from_world.transpose() * camera.intrinsics.inverse()) {}
  [[nodiscard]] Ray at(double x, double y) const { return {center_, world_from_pixel_ * Vector3d(x, y, 1.0)}; }

 private:
  Vector3d center_;
  Eigen::Matrix3d world_from_pixel_;
};

/// Mean of four samples spread over the pixel's square.
Vector3d pixel_color(const RayMaker& rays, const Solid& bounds, const Lights& lights, int x, int y,
                     const TempleOptions& options) {
  Vector3d sum = Vector3d::Zero();
  for (const double dy : {-0.25, 0.25}) {
    for (const double dx : {-0.25, 0.25}) {
      const Ray ray = rays.at(x + dx, y + dy);
      if (intersect(bounds, ray)) sum += radiance(ray, lights, options);
    }
  }
  return sum / 4.0;
}

/// What the sensor makes of a color: exposure, noise, 8 bits.
Rgba expose(const Vector3d& color, double noise, std::uint64_t pixel_key) {
  constexpr double kExposure = 255.0;
  std::array<std::uint32_t, 3> values{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double level = kExposure * color[static_cast<int>(channel)] + noise * gaussian_from_hash(pixel_key + channel);
    values[channel] = static_cast<std::uint32_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0));
  }
  return make_rgb(values[0], values[1], values[2]);
}

}  // namespace

ColorImage render_temple(const Scene& scene, int view, const TempleOptions& options) {
  QUORUM_CHECK_GE(view, 0);
  QUORUM_CHECK_LT(static_cast<std::size_t>(view), scene.views.size());
  const View& photograph = scene.views[static_cast<std::size_t>(view)];
  const RayMaker rays(photograph.camera);
  const Solid bounds = Box{scene.bounds};
  const std::uint64_t view_key = mix(mix(options.seed) + static_cast<std::uint64_t>(view));
  const Lights lights = lights_of_view(options, view_key);
  ColorImage image(photograph.width, photograph.height);
  tbb::parallel_for(tbb::blocked_range<int>(0, image.height), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      for (int x = 0; x < image.width; ++x) {
        const std::uint64_t index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(image.width) + x;
        image.at(x, y) =
            expose(pixel_color(rays, bounds, lights, x, y, options), options.noise, mix(view_key + 4 * index));
      }
    }
  });
  return image;
}

}  // namespace quorum
