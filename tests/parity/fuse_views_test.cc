#include "engine/pipeline/fuse_views.h"

#include <algorithm>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/filled_patches.h"
#include "engine/pipeline/cpu_backend.h"
#include "host/vulkan_backend.h"
#include "tests/parity/parity_test.h"
#include "tests/support/fusion_scene.h"
#include "tests/support/limited_backend.h"
#include "tests/support/mesh_measures.h"

namespace quorum {
namespace {

using FuseViewsParity = ParityTest;

TEST_F(FuseViewsParity, SlabsOnTheDeviceGiveTheMeshOfTheCpu) {
  const FusionScene scene;
  CpuBackend cpu;
  RunReport whole_report;
  const Mesh whole = scene.fuse(cpu, whole_report).value();
  ASSERT_GT(whole.triangles.size(), 1000U);
  const auto gpu = VulkanBackend::create(device()).value();
  for (const std::size_t most : {std::size_t{1} << 30, std::size_t{70}}) {
    LimitedBackend limited(*gpu, most);
    RunReport report;
    const auto mesh = scene.fuse(limited, report);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(report.slabs > 1, most < whole_report.blocks);
    EXPECT_LE(limited.largest_volume, most);
    EXPECT_TRUE(same_mesh(*mesh, whole)) << most << " blocks at once";
  }
}

TEST_F(FuseViewsParity, HolesAreFilledOnTheDeviceAsOnTheCpu) {
  const FusionScene scene(true);
  CpuBackend cpu;
  const auto gpu = VulkanBackend::create(device()).value();
  for (const double mask_below : {0.0, 0.02}) {
    RunReport report;
    const Mesh expected = scene.fill(cpu, report, mask_below).value();
    EXPECT_EQ(std::ranges::count_if(expected.vertices, is_filled) > 100, mask_below > 0) << mask_below;
    const auto mesh = scene.fill(*gpu, report, mask_below);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(same_mesh(*mesh, expected)) << mask_below;
  }
}

TEST_F(FuseViewsParity, HolesAreFilledWhereKernelsSeeLittleOfABuffer) {
  const FusionScene scene(true);
  CpuBackend cpu;
  RunReport report;
  const Mesh expected = scene.fill(cpu, report, 0.02, 0.02).value();
  constexpr std::uint64_t kLittle = 1U << 16;  // more than a view's map, less than 64 bytes for each of 2,744 blocks
  const Device limited =
      Device::open(device().info(), {.validation = true, .max_storage_buffer_range = kLittle}).value();
  const auto backend = VulkanBackend::create(limited).value();
  EXPECT_TRUE(same_mesh(scene.fill(*backend, report, 0.02, 0.02).value(), expected));
  for (const std::string& message : limited.take_validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace quorum
