#include "engine/volume/integrate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/volume/range_surface.h"
#include "tests/engine/volume/plane_input.h"
#include "tests/support/range_params.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kIntegrateWidth = 81;
constexpr int kIntegrateHeight = 61;
constexpr std::uint32_t kWeight = 100;

VoxelGrid grid_around() {
  VoxelGrid grid;
  grid.voxel_size = 0.02;
  grid.truncation = 0.08;
  grid.origin = {-0.4, -0.3, 1.8};
  grid.blocks = {5, 4, 3};
  return grid;
}

std::vector<std::uint32_t> blocks_of(const VoxelGrid& grid) {
  std::vector<std::uint32_t> blocks(grid.block_count());
  std::iota(blocks.begin(), blocks.end(), 0U);
  return blocks;
}

/// All voxels of the grid after one map of constant weight. cosine: of all vertices, 0..1.
std::vector<Voxel> integrate_map(const Camera& camera, const Grid<float>& depth, const ColorImage& image,
                                 const VoxelGrid& grid, double cosine = 1.0) {
  FusionOptions options;
  options.max_slope_deg = 80;
  const auto cells =
      range_surface(depth, make_range_surface_params(camera, kIntegrateWidth, kIntegrateHeight, options));
  const auto word = kWeight | static_cast<std::uint32_t>(std::lround(cosine * kCosineScale)) << kWeightBits;
  const auto blocks = blocks_of(grid);
  std::vector<Voxel> voxels(blocks.size() * kBlockVoxels);
  integrate({depth, cells, Grid<std::uint32_t>(kIntegrateWidth, kIntegrateHeight, word), pad_image(image)},
            find_slots(blocks, blocks), make_integrate_params(camera, kIntegrateWidth, kIntegrateHeight, grid),
            best_simd_level(), voxels);
  return voxels;
}

Eigen::Vector3d voxel_position(const VoxelGrid& grid, std::size_t index) {
  const auto [bx, by, bz] = grid.block_position(static_cast<std::uint32_t>(index / kBlockVoxels));
  const int voxel = static_cast<int>(index % kBlockVoxels);
  return grid.origin +
         grid.voxel_size * Eigen::Vector3d(bx * 8 + voxel % 8, by * 8 + voxel / 8 % 8, bz * 8 + voxel / 64);
}

TEST(Integrate, PlanesGiveTheirDistanceAlongTheLineOfSightTimesTheCosine) {
  const Camera camera = straight_camera(kIntegrateWidth, kIntegrateHeight, 160);
  const VoxelGrid grid = grid_around();
  for (const auto& [angle, cosine] : {std::pair{0.0, 1.0}, {50.0, 1.0}, {50.0, 0.625}}) {
    const double slope = std::tan(angle * std::numbers::pi / 180.0);
    const auto voxels = integrate_map(camera, plane_depth(camera, kIntegrateWidth, kIntegrateHeight, 2.0, angle),
                                      ColorImage(kIntegrateWidth, kIntegrateHeight, make_rgb(1, 2, 3)), grid, cosine);
    int seen = 0;
    int behind = 0;
    for (std::size_t index = 0; index < voxels.size(); ++index) {
      const Eigen::Vector3d position = voxel_position(grid, index);
      const Eigen::Vector3d pixel = camera.project(position);
      const bool visible =
          pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < kIntegrateWidth - 1 && pixel.y() < kIntegrateHeight - 1;
      const double on_ray = 2.0 / (1.0 - slope * position.x() / position.z());
      const double distance = (on_ray - position.z()) * (position.norm() / position.z()) * cosine / grid.truncation;
      // Inverse depth is linear on a plane, depth on a triangle: they differ by far less than this.
      constexpr double kFuzz = 2e-3;
      if (!visible || distance > 1.0 + kFuzz || distance < -kBehindShare - kFuzz) {
        EXPECT_EQ(voxels[index].weight, 0) << position.transpose();
        EXPECT_EQ(voxels[index].distance, 0);
        EXPECT_EQ(voxels[index].color[0], 0);
      } else if (distance < 1.0 - kFuzz && distance > -kBehindShare + kFuzz) {
        ASSERT_EQ(voxels[index].weight, static_cast<int>(kWeight)) << position.transpose();
        const double measured = static_cast<double>(voxels[index].distance) / kWeight / kDistanceScale;
        EXPECT_NEAR(measured, distance, 0.5 / kDistanceScale + (angle > 0 ? kFuzz : 1e-4)) << position.transpose();
        ++seen;
        behind += measured < 0 ? 1 : 0;
      }
    }
    EXPECT_GT(seen, 3000);
    EXPECT_GT(behind, seen / 6);
  }
}

TEST(Integrate, ColorsComeFromTheImage) {
  const Camera camera = straight_camera(kIntegrateWidth, kIntegrateHeight, 160);
  const VoxelGrid grid = grid_around();
  ColorImage image(kIntegrateWidth, kIntegrateHeight);
  for (int y = 0; y < kIntegrateHeight; ++y)
    for (int x = 0; x < kIntegrateWidth; ++x)
      image.at(x, y) = make_rgb(static_cast<std::uint32_t>(3 * x), static_cast<std::uint32_t>(4 * y), 255);
  const auto voxels = integrate_map(camera, Grid<float>(kIntegrateWidth, kIntegrateHeight, 2.0F), image, grid);
  int seen = 0;
  for (std::size_t index = 0; index < voxels.size(); ++index) {
    const Voxel& voxel = voxels[index];
    if (voxel.weight == 0) continue;
    ++seen;
    const Eigen::Vector3d pixel = camera.project(voxel_position(grid, index));
    EXPECT_NEAR(static_cast<double>(voxel.color[0]) / voxel.weight, 3 * pixel.x(), 0.52);
    EXPECT_NEAR(static_cast<double>(voxel.color[1]) / voxel.weight, 4 * pixel.y(), 0.52);
    EXPECT_EQ(voxel.color[2], 255 * voxel.weight);
  }
  EXPECT_GT(seen, 3000);
}

/// All voxels around a sphere after the given of its three views.
std::vector<Voxel> fuse_sphere(std::initializer_list<std::size_t> order, SimdLevel simd = best_simd_level()) {
  const SphereScene sphere = make_sphere_scene(3, kIntegrateWidth, kIntegrateHeight, true, 1);
  FusionOptions options;
  options.voxel_size = 0.1;
  const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
  const auto blocks = blocks_of(grid);
  std::vector<Voxel> voxels(blocks.size() * kBlockVoxels);
  for (const std::size_t index : order) {
    const View& view = sphere.scene.views[index];
    Grid<float> depth(kIntegrateWidth, kIntegrateHeight);
    Grid<std::uint32_t> weights(kIntegrateWidth, kIntegrateHeight);
    for (int y = 0; y < kIntegrateHeight; ++y) {
      for (int x = 0; x < kIntegrateWidth; ++x) {
        depth.at(x, y) = static_cast<float>(sphere_depth(view, x, y));
        weights.at(x, y) = static_cast<std::uint32_t>(1 + (x * 7 + y * 13) % 255);
      }
    }
    const auto cells =
        range_surface(depth, make_range_surface_params(view.camera, kIntegrateWidth, kIntegrateHeight, options));
    integrate({depth, cells, weights, pad_image(sphere.images[index])}, find_slots(blocks, blocks),
              make_integrate_params(view.camera, kIntegrateWidth, kIntegrateHeight, grid), simd, voxels);
  }
  return voxels;
}

bool equal(const Voxel& a, const Voxel& b) {
  return a.weight == b.weight && a.distance == b.distance && std::ranges::equal(a.color, b.color);
}

TEST(Integrate, InstructionsDoNotChangeTheBytes) {
  const auto expected = fuse_sphere({0, 1, 2}, SimdLevel::kBaseline);
  EXPECT_GT(std::ranges::count_if(expected, [](const Voxel& voxel) { return voxel.weight > 0; }), 1000);
  for (const SimdLevel simd : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (simd > best_simd_level()) continue;
    EXPECT_TRUE(std::ranges::equal(fuse_sphere({0, 1, 2}, simd), expected, equal)) << static_cast<int>(simd);
  }
}

TEST(Integrate, TheOrderOfViewsDoesNotMatterAndSumsAddUp) {
  const auto forward = fuse_sphere({0, 1, 2});
  EXPECT_TRUE(std::ranges::equal(forward, fuse_sphere({2, 0, 1}), equal));
  const auto a = fuse_sphere({0});
  const auto b = fuse_sphere({1});
  const auto both = fuse_sphere({0, 1});
  int shared = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_EQ(both[i].weight, a[i].weight + b[i].weight);
    EXPECT_EQ(both[i].distance, a[i].distance + b[i].distance);
    shared += a[i].weight > 0 && b[i].weight > 0 ? 1 : 0;
  }
  EXPECT_GT(shared, 500);
}

TEST(Integrate, NothingIsSeenWithoutSurfaceOrFromBehind) {
  const Camera camera = straight_camera(kIntegrateWidth, kIntegrateHeight, 160);
  const ColorImage image(kIntegrateWidth, kIntegrateHeight, make_rgb(9, 9, 9));
  const auto unseen = [](const Voxel& voxel) { return voxel.weight == 0 && voxel.distance == 0; };
  EXPECT_TRUE(std::ranges::all_of(
      integrate_map(camera, Grid<float>(kIntegrateWidth, kIntegrateHeight), image, grid_around()), unseen));
  VoxelGrid behind = grid_around();
  behind.origin.z() = -2.2;
  EXPECT_TRUE(std::ranges::all_of(
      integrate_map(camera, Grid<float>(kIntegrateWidth, kIntegrateHeight, 2.0F), image, behind), unseen));
}

TEST(Integrate, OnlyListedBlocksAreTouched) {
  const Camera camera = straight_camera(kIntegrateWidth, kIntegrateHeight, 160);
  const VoxelGrid grid = grid_around();
  const Grid<float> depth(kIntegrateWidth, kIntegrateHeight, 2.0F);
  const auto cells = range_surface(depth, slope_alone(kIntegrateWidth, kIntegrateHeight, 0.01F));
  const Grid<std::uint32_t> weights(kIntegrateWidth, kIntegrateHeight, kWeight);
  const PaddedImage image = pad_image(ColorImage(kIntegrateWidth, kIntegrateHeight));
  const auto params = make_integrate_params(camera, kIntegrateWidth, kIntegrateHeight, grid);
  std::vector<Voxel> voxels(3 * kBlockVoxels);
  integrate({depth, cells, weights, image}, {}, params, best_simd_level(), voxels);
  const auto seen_in = [&](std::ptrdiff_t slot) {
    return std::count_if(voxels.begin() + slot * kBlockVoxels, voxels.begin() + (slot + 1) * kBlockVoxels,
                         [](const Voxel& voxel) { return voxel.weight > 0; });
  };
  for (const std::ptrdiff_t slot : {0, 1, 2}) EXPECT_EQ(seen_in(slot), 0);
  integrate({depth, cells, weights, image}, {{grid.block_index(2, 2, 1), 1}}, params, best_simd_level(), voxels);
  EXPECT_EQ(seen_in(0), 0);
  EXPECT_GT(seen_in(1), 100);
  EXPECT_EQ(seen_in(2), 0);
}

TEST(FindSlots, GivesThePlaceOfEachBlockInThePool) {
  const auto slots = find_slots({3, 9}, {1, 3, 7, 9});
  ASSERT_EQ(slots.size(), 2U);
  EXPECT_EQ(slots[0].index, 3U);
  EXPECT_EQ(slots[0].slot, 1U);
  EXPECT_EQ(slots[1].index, 9U);
  EXPECT_EQ(slots[1].slot, 3U);
  EXPECT_TRUE(find_slots({}, {1, 2}).empty());
  EXPECT_TRUE(find_slots({}, {}).empty());
}

}  // namespace
}  // namespace quorum
