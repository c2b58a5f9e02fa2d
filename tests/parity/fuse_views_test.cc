#include "engine/pipeline/fuse_views.h"

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

}  // namespace
}  // namespace quorum
