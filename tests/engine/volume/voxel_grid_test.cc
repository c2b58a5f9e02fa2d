#include "engine/volume/voxel_grid.h"

#include <gtest/gtest.h>

#include "tests/engine/scene/camera_paths.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

TEST(VoxelGrid, CoversTheBoundsAndOneTruncationMore) {
  const Scene scene = make_sphere_scene(3, 60, 40, false, 1).scene;
  FusionOptions options;
  options.voxel_size = 0.03;
  options.truncation = 0.1;
  const VoxelGrid grid = make_voxel_grid(scene, options).value();
  EXPECT_EQ(grid.voxel_size, 0.03);
  EXPECT_EQ(grid.truncation, 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    const double last =
        grid.origin(axis) + grid.voxel_size * (kBlockSide * grid.blocks[static_cast<std::size_t>(axis)] - 1);
    EXPECT_LE(grid.origin(axis), scene.bounds.low(axis) - grid.truncation);
    EXPECT_GE(last, scene.bounds.high(axis) + grid.truncation);
    EXPECT_LT(last, scene.bounds.high(axis) + grid.truncation + 9 * grid.voxel_size);
  }
}

TEST(VoxelGrid, AutomaticVoxelsAreAPixelsFootprintAndTheTruncationThreeOrFour) {
  const Scene scene = make_sphere_scene(3, 60, 40, false, 1).scene;
  const VoxelGrid grid = make_voxel_grid(scene, {}).value();
  EXPECT_NEAR(grid.voxel_size, 4.0 / (1.405 * 60), 1e-9);
  EXPECT_NEAR(grid.truncation, 3 * grid.voxel_size, 1e-12);
  FusionOptions along_rays;
  along_rays.signed_distance = SignedDistance::kRay;
  EXPECT_NEAR(make_voxel_grid(scene, along_rays).value().truncation, 4 * grid.voxel_size, 1e-12);
}

TEST(VoxelGrid, AroundCamerasInARoomAutomaticVoxelsFollowFromTheirRays) {
  const VoxelGrid grid = make_voxel_grid(room(45), {}).value();  // its center lies behind every camera
  EXPECT_GT(grid.voxel_size, 0.5 / 300);
  EXPECT_LT(grid.voxel_size, 3.0 / 300);
}

TEST(VoxelGrid, BlockIndicesAndPositionsAreInverse) {
  VoxelGrid grid;
  grid.blocks = {3, 4, 5};
  EXPECT_EQ(grid.block_count(), 60U);
  EXPECT_EQ(grid.block_index(1, 0, 0), 1U);
  EXPECT_EQ(grid.block_index(0, 1, 0), 3U);
  EXPECT_EQ(grid.block_index(0, 0, 1), 12U);
  for (std::uint32_t index = 0; index < 60; ++index) {
    const auto [x, y, z] = grid.block_position(index);
    EXPECT_EQ(grid.block_index(x, y, z), index);
  }
}

TEST(VoxelGrid, OneVoxelForTheWholeSceneIsAGrid) {
  FusionOptions options;
  options.voxel_size = 10.0;
  const VoxelGrid grid = make_voxel_grid(make_sphere_scene(2, 60, 40, false, 1).scene, options).value();
  for (const int blocks : grid.blocks) EXPECT_GE(blocks, 1);
  EXPECT_LE(grid.block_count(), 8U);
}

TEST(VoxelGrid, GridsBeyondTheLimitAreRefusedWithARemedy) {
  FusionOptions options;
  options.voxel_size = 1e-5;
  const auto grid = make_voxel_grid(make_sphere_scene(2, 60, 40, false, 1).scene, options);
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().kind, ErrorKind::kUsage);
  EXPECT_NE(grid.error().message.find("larger voxel"), std::string::npos) << grid.error().message;
}

TEST(VoxelGrid, AutomaticVoxelsAreCoarserWhereTheBoundsHoldTooManyOfThem) {
  Scene scene = make_sphere_scene(3, 60, 40, false, 1).scene;
  const double footprint = make_voxel_grid(scene, {}).value().voxel_size;
  EXPECT_FALSE(make_voxel_grid(scene, {}).value().is_coarse);
  for (View& view : scene.views) view.camera.intrinsics.topRows<2>() *= 1000.0;
  const VoxelGrid grid = make_voxel_grid(scene, {}).value();
  EXPECT_TRUE(grid.is_coarse);
  EXPECT_GT(grid.voxel_size, footprint / 1000);
  EXPECT_LE(grid.block_count(), std::size_t{1} << 30);
  EXPECT_GT(grid.block_count(), std::size_t{1} << 28) << "no coarser than it must be";
  EXPECT_NEAR(grid.truncation, 3 * grid.voxel_size, 1e-12);
}

TEST(VoxelGrid, TruncationOutOfRangeIsRefused) {
  const Scene scene = make_sphere_scene(2, 60, 40, false, 1).scene;
  FusionOptions options;
  options.voxel_size = 0.1;
  for (const double truncation : {0.14, 3.3}) {
    options.truncation = truncation;
    const auto grid = make_voxel_grid(scene, options);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().kind, ErrorKind::kUsage);
  }
}

TEST(VoxelGrid, BoundsBehindEveryCameraHaveNoAutomaticVoxel) {
  Scene scene = make_sphere_scene(2, 60, 40, false, 1).scene;
  scene.bounds = {{-1, -1, -101}, {1, 1, -99}};
  const auto grid = make_voxel_grid(scene, {});
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace quorum
