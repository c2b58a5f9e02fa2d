#include "engine/render/render_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "engine/core/grid.h"
#include "engine/render/shading.h"

namespace quorum {
namespace {

/// The point that is nearest along a ray.
struct Nearest {
  double depth = std::numeric_limits<double>::infinity();
  const Vertex* vertex = nullptr;
};

/// Per sample the nearest point that covers it. Pixel x has the samples 2 x and 2 x + 1.
Grid<Nearest> splat(const Mesh& cloud, const Camera& camera, int width, int height) {
  constexpr int kReach = 1;  // samples to each side
  Grid<Nearest> samples(2 * width, 2 * height);
  for (const Vertex& vertex : cloud.vertices) {
    if (!vertex.position.allFinite()) continue;
    const Eigen::Vector3d pixel = camera.project(vertex.position.cast<double>());
    if (!(pixel.z() > 0 && std::abs(pixel.x()) < 1e6 && std::abs(pixel.y()) < 1e6)) continue;
    const int x = static_cast<int>(std::lround(2 * pixel.x() + 0.5));
    const int y = static_cast<int>(std::lround(2 * pixel.y() + 0.5));
    for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, samples.height - 1); ++v)
      for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, samples.width - 1); ++u)
        if (pixel.z() < samples.at(u, v).depth) samples.at(u, v) = {pixel.z(), &vertex};
  }
  return samples;
}

Color sample_color(const Nearest& nearest, const Camera& camera, const RenderOptions& options) {
  if (nearest.vertex == nullptr) return kBackground;
  const Vertex& vertex = *nearest.vertex;
  const Eigen::Vector3f to_camera = -camera.to_camera(vertex.position.cast<double>()).normalized().cast<float>();
  SurfaceSample sample{vertex_color(vertex), vertex.confidence, to_camera};
  if (!vertex.normal.isZero(0)) sample.normal = camera.camera_from_world.cast<float>() * vertex.normal;
  sample.is_back = sample.normal.dot(to_camera) < 0;
  if (sample.is_back) sample.normal = -sample.normal;
  return shade(sample, to_camera, options);
}

}  // namespace

Expected<ColorImage> render_points(const Mesh& cloud, const Camera& camera, int width, int height,
                                   const RenderOptions& options) {
  QUORUM_CHECK_GE(width, 0);
  QUORUM_CHECK_GE(height, 0);
  QUORUM_TRY(options.check());
  const RenderOptions settled = settle(options, cloud);
  const Grid<Nearest> samples = splat(cloud, camera, width, height);
  ColorImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Color sum = Color::Zero();
      for (const int v : {2 * y, 2 * y + 1})
        for (const int u : {2 * x, 2 * x + 1}) sum += sample_color(samples.at(u, v), camera, settled);
      image.at(x, y) = to_pixel(sum / 4);
    }
  }
  return image;
}

}  // namespace quorum
