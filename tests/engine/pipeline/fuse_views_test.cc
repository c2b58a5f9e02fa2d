#include "engine/pipeline/fuse_views.h"

#include <gtest/gtest.h>

#include "engine/pipeline/cpu_backend.h"
#include "tests/support/fusion_scene.h"
#include "tests/support/limited_backend.h"
#include "tests/support/mesh_measures.h"

namespace quorum {
namespace {

TEST(FuseViews, SlabsLeaveEveryByteAlone) {
  const FusionScene scene;
  CpuBackend cpu;
  RunReport whole_report;
  const auto whole = scene.fuse(cpu, whole_report);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole_report.slabs, 1);
  ASSERT_GT(whole_report.blocks, 250U);
  EXPECT_TRUE(measure_mesh(*whole).closed);
  for (const std::size_t most : {std::size_t{4}, std::size_t{37}, std::size_t{150}, whole_report.blocks - 1}) {
    LimitedBackend limited(cpu, most);
    RunReport report;
    const auto mesh = scene.fuse(limited, report);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_GT(report.slabs, 1);
    EXPECT_LE(limited.largest_volume, most);
    EXPECT_EQ(report.blocks, whole_report.blocks);
    EXPECT_TRUE(same_mesh(*mesh, *whole)) << most << " blocks at once";
  }
}

TEST(FuseViews, OnlyBlocksInSightOfAViewAreVisited) {
  const FusionScene scene;
  CpuBackend cpu;
  LimitedBackend counting(cpu, std::size_t{1} << 30);
  RunReport report;
  ASSERT_TRUE(scene.fuse(counting, report));
  EXPECT_EQ(counting.integrated_block_views, report.block_views);
  EXPECT_LT(report.block_views, report.blocks * 10 / 2);  // ten views, each of which sees less than half of the sphere
}

TEST(FuseViews, ABudgetThatHoldsNoSlabIsRefusedWithTheLeastThatWouldDo) {
  const FusionScene scene;
  CpuBackend cpu;
  RunReport report;
  const auto refused = scene.fuse(cpu, report, 1 << 20);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
  EXPECT_NE(refused.error().message.find("give --memory "), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace quorum
