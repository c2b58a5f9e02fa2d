// The volume as a whole, from exact depth maps of a sphere to its mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/marching_cubes.h"
#include "engine/pipeline/cpu_backend.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kWidth = 161;
constexpr int kHeight = 151;
constexpr double kVoxel = 0.05;

DepthMap exact_map(const View& view) {
  DepthMap map;
  map.depth = map.correlation = map.confidence = Grid<float>(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      map.depth.at(x, y) = static_cast<float>(sphere_depth(view, x, y));
      if (map.depth.at(x, y) > 0) map.correlation.at(x, y) = map.confidence.at(x, y) = 1.0F;
    }
  }
  return map;
}

Mesh fuse(const SphereScene& sphere, const FusionOptions& options) {
  const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
  std::vector<DepthMap> maps;
  std::vector<PaddedImage> images;
  for (std::size_t index = 0; index < sphere.images.size(); ++index) {
    maps.push_back(exact_map(sphere.scene.views[index]));
    images.push_back(pad_image(sphere.images[index]));
  }
  const auto view = [&](std::size_t index) {
    return FusionView{maps[index], images[index], sphere.scene.views[index].camera};
  };
  CpuBackend backend;
  EXPECT_TRUE(backend.begin_volume(grid, options));
  std::vector<std::vector<std::uint32_t>> blocks;
  std::vector<std::uint32_t> all;
  for (std::size_t index = 0; index < maps.size(); ++index) {
    blocks.push_back(backend.collect_blocks(view(index)).value());
    all.insert(all.end(), blocks[index].begin(), blocks[index].end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  EXPECT_TRUE(backend.allocate_blocks(all));
  for (std::size_t index = 0; index < maps.size(); ++index) EXPECT_TRUE(backend.integrate(view(index), blocks[index]));
  return marching_cubes(backend.read_blocks().value(), grid);
}

TEST(SphereFusion, ViewsAllAroundGiveTheClosedSphere) {
  FusionOptions options;
  options.voxel_size = kVoxel;
  for (const SignedDistance distance : {SignedDistance::kNormal, SignedDistance::kRay}) {
    SCOPED_TRACE(distance == SignedDistance::kNormal ? "normal" : "ray");
    options.signed_distance = distance;
    // Halfway between two cameras the sight is 58 degrees off the normal: cubes on the surface reach 3.3 voxels behind
    // it along the ray.
    options.truncation = (distance == SignedDistance::kNormal ? 4 : 8) * kVoxel;
    const Mesh mesh = fuse(make_surrounding_sphere_scene(12, kWidth, kHeight, 1), options);
    const MeshMeasures measures = measure_mesh(mesh);
    const double area = 4.0 * std::numbers::pi * kSphereRadius * kSphereRadius;
    EXPECT_TRUE(measures.closed);
    EXPECT_EQ(measures.euler_characteristic, 2);
    EXPECT_NEAR(measures.area, area, 0.02 * area);
    EXPECT_NEAR(measures.volume, area / 3.0 * kSphereRadius, 0.02 * area / 3.0 * kSphereRadius);
    ASSERT_GT(mesh.vertices.size(), 5000U);
    for (const Vertex& vertex : mesh.vertices) {
      EXPECT_NEAR(vertex.position.cast<double>().norm(), kSphereRadius, 0.5 * kVoxel);
      EXPECT_GT(vertex.confidence, 0.0F);
      EXPECT_GT(vertex.normal.dot(vertex.position), 0.9F);
    }
  }
}

TEST(SphereFusion, OneViewGivesItsSideAlone) {
  FusionOptions options;
  options.voxel_size = kVoxel;
  SphereScene sphere = make_surrounding_sphere_scene(12, kWidth, kHeight, 1);
  sphere.scene.views.resize(1);
  sphere.images.resize(1);
  const Eigen::Vector3f toward = sphere.scene.views[0].camera.center().normalized().cast<float>();
  const Mesh mesh = fuse(sphere, options);
  EXPECT_FALSE(measure_mesh(mesh).closed);
  ASSERT_GT(mesh.vertices.size(), 1000U);
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.position.cast<double>().norm(), kSphereRadius, 0.5 * kVoxel);
    EXPECT_GT(vertex.position.dot(toward), 0.2F);  // a camera 4 radii away sees down to 1/4
  }
}

TEST(SphereFusion, ColorsComeFromTheImages) {
  FusionOptions options;
  options.voxel_size = kVoxel;
  SphereScene sphere = make_surrounding_sphere_scene(12, kWidth, kHeight, 1);
  for (ColorImage& image : sphere.images) std::ranges::fill(image.values, make_rgb(200, 100, 50));
  for (const Vertex& vertex : fuse(sphere, options).vertices) ASSERT_EQ(vertex.color, make_rgb(200, 100, 50));
}

}  // namespace
}  // namespace quorum
