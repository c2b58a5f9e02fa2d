#include "engine/pipeline/fuse_views.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <bit>
#include <set>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/filled_patches.h"
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
  EXPECT_NE(refused.error().message.find("give option memory "), std::string::npos) << refused.error().message;
}

/// All but the normal, which depends on the triangles around.
using VertexKey = std::array<std::uint32_t, 5>;
VertexKey key_of(const Vertex& vertex) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  return {bits(vertex.position.x()), bits(vertex.position.y()), bits(vertex.position.z()), vertex.color,
          bits(vertex.confidence)};
}

constexpr double kDark = 0.02;

TEST(FuseViews, AHoleInEveryDepthMapIsFilledWithConfidenceZeroAndNothingElseMoves) {
  const FusionScene scene(true);
  CpuBackend cpu;
  RunReport report;
  const Mesh open = scene.fuse(cpu, report).value();
  EXPECT_FALSE(measure_mesh(open).closed);
  const Mesh filled = scene.fill(cpu, report, kDark).value();
  const MeshMeasures measures = measure_mesh(filled);
  EXPECT_TRUE(measures.closed);
  EXPECT_EQ(measures.euler_characteristic, 2);
  std::set<VertexKey> measured;
  int in_hole = 0;
  for (const Vertex& vertex : filled.vertices) {
    if (!is_filled(vertex)) {
      measured.insert(key_of(vertex));
      continue;
    }
    ++in_hole;
    const Eigen::Vector3d position = vertex.position.cast<double>();
    EXPECT_GT(position.normalized().dot(FusionScene::hole_center()), FusionScene::kHoleCosine - 0.08);
    EXPECT_GT(position.norm(), 0.9);
    EXPECT_LT(position.norm(), 1.25);
    EXPECT_NE(vertex.color, Vertex().color) << "no color from around";
  }
  EXPECT_GT(in_hole, 200);
  for (const Vertex& vertex : open.vertices) EXPECT_TRUE(measured.contains(key_of(vertex)));
}

TEST(FuseViews, SlabsAndThreadsFillHolesAlike) {
  const FusionScene scene(true);
  CpuBackend cpu;
  RunReport whole_report;
  const Mesh whole = scene.fill(cpu, whole_report, kDark).value();
  for (const std::size_t most : {std::size_t{4}, std::size_t{60}}) {
    LimitedBackend limited(cpu, most);
    RunReport report;
    EXPECT_TRUE(same_mesh(scene.fill(limited, report, kDark).value(), whole)) << most << " blocks at once";
    EXPECT_GT(report.slabs, 1);
  }
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  RunReport report;
  EXPECT_TRUE(same_mesh(scene.fill(cpu, report, kDark).value(), whole));
}

TEST(FuseViews, OnePixelThatAMaskLeavesOutIsNotABackground) {
  CpuBackend cpu;
  RunReport report;
  FusionScene scene(true);
  const Mesh expected = scene.fill(cpu, report, 0.0).value();
  scene.mask_pixel(0, 3, 3);
  EXPECT_TRUE(same_mesh(scene.fill(cpu, report, 0.0).value(), expected));
}

TEST(FuseViews, AClosedSurfaceGetsNoFilledVertex) {
  const FusionScene scene;
  CpuBackend cpu;
  RunReport report;
  const Mesh open = scene.fuse(cpu, report).value();
  for (const double mask_below : {0.0, kDark}) {
    const Mesh filled = scene.fill(cpu, report, mask_below).value();
    EXPECT_TRUE(same_mesh(filled, open)) << mask_below;
  }
}

}  // namespace
}  // namespace quorum
