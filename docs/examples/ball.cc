// A ball whose photographs exist in memory alone: arrays in, arrays out.
#include <quorum/quorum.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

constexpr int kViews = 6;
constexpr int kWidth = 160;      // pixels
constexpr int kHeight = 120;     // pixels
constexpr double kFocal = 200;   // pixels
constexpr double kDistance = 4;  // from each camera to the middle of the ball, whose radius is 1

double hash(int x, int y, int z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U ^
                    static_cast<std::uint32_t>(z) * 83492791U;
  h = (h ^ (h >> 13U)) * 1274126177U;
  return (h >> 8U & 0xffffU) / 65535.0;
}

// Smooth noise, 0 to 1: the ball's texture.
double noise(double x, double y, double z) {
  const int i = static_cast<int>(std::floor(x));
  const int j = static_cast<int>(std::floor(y));
  const int k = static_cast<int>(std::floor(z));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1;
    const int b = corner >> 1 & 1;
    const int c = corner >> 2;
    sum +=
        hash(i + a, j + b, k + c) * (1 - std::abs(x - i - a)) * (1 - std::abs(y - j - b)) * (1 - std::abs(z - k - c));
  }
  return sum;
}

struct Photograph {
  quorum::Camera camera;
  std::vector<std::uint8_t> gray = std::vector<std::uint8_t>(kWidth * kHeight);
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(kWidth * kHeight);
};

// From a place on a ring around the ball, toward its middle.
Photograph photograph(double angle) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  Photograph made;
  made.camera.intrinsics = {kFocal, 0, kWidth / 2.0, 0, kFocal, kHeight / 2.0, 0, 0, 1};
  made.camera.camera_from_world = {c, 0, -s, 0, 1, 0, s, 0, c};
  made.camera.translation = {0, 0, kDistance};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x - kWidth / 2.0) / kFocal;
      const double v = (y - kHeight / 2.0) / kFocal;
      const double norm = u * u + v * v + 1;
      const double root = kDistance * kDistance - norm * (kDistance * kDistance - 1);
      if (root < 0) continue;  // the ray misses the ball
      const double depth = (kDistance - std::sqrt(root)) / norm;
      const double z = depth - kDistance;
      const double world_x = c * u * depth + s * z;
      const double world_z = -s * u * depth + c * z;
      const auto pixel = static_cast<std::size_t>(y * kWidth + x);
      const double value = 0.5 * noise(7 * world_x, 7 * v * depth, 7 * world_z) +
                           0.5 * noise(15 * world_x, 15 * v * depth, 15 * world_z);
      made.gray[pixel] = static_cast<std::uint8_t>(255 * value);
      made.mask[pixel] = 255;
    }
  return made;
}

int fail(const quorum::Error& error) {
  std::fprintf(stderr, "ball: %s\n", error.message.c_str());
  return static_cast<int>(error.kind);
}

}  // namespace

int main() {
  std::vector<Photograph> photographs;
  for (int i = 0; i < kViews; ++i) photographs.push_back(photograph(0.2 * i));

  quorum::SceneArrays arrays;
  for (const Photograph& photo : photographs) {
    quorum::ViewArrays view;
    view.image = {photo.gray.data(), kWidth, kHeight, 1};
    view.mask = {photo.mask.data(), kWidth, kHeight, 1};
    view.camera = photo.camera;
    arrays.views.push_back(view);
  }
  arrays.bounds = {-1.1, -1.1, -1.1, 1.1, 1.1, 1.1};
  const auto scene = quorum::Scene::from_arrays(arrays);
  if (!scene) return fail(scene.error());

  quorum::Options options;
  options.set("neighbors", 4).set("min-component", 0).set("confirm", true);
  const auto results = quorum::reconstruct(*scene, options);
  if (!results) return fail(results.error());

  const auto map = results->depth_map(2);
  if (!map) return fail(map.error());
  const std::size_t middle = kHeight / 2 * kWidth + kWidth / 2;
  std::printf("depth in the middle of view 2: %.3f, certainty %.2f; the truth is 3\n",
              static_cast<double>(map->depth[middle]), static_cast<double>(map->certainty[middle]));

  const auto mesh = results->mesh();
  if (!mesh) return fail(mesh.error());
  double error = 0;
  for (std::size_t i = 0; i < mesh->vertex_count(); ++i) {
    const double x = static_cast<double>(mesh->positions[3 * i]);
    const double y = static_cast<double>(mesh->positions[3 * i + 1]);
    const double z = static_cast<double>(mesh->positions[3 * i + 2]);
    error += std::abs(std::hypot(x, y, z) - 1);
  }
  std::printf("%zu triangles; vertices are %.4f off the ball of radius 1 in the mean\n", mesh->triangle_count(),
              error / static_cast<double>(mesh->vertex_count()));
}
