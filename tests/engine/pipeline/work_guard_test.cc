// A guard against work that creeps in: counts of a small fixed scene, which do not depend on the machine. Times belong
// to `quorum bench`.
#include <gtest/gtest.h>

#include "engine/io/write_image.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/reconstruct.h"
#include "engine/synthetic/temple.h"
#include "tests/support/limited_backend.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// One count and what it was when it was stored; a hundredth more may come from another rounding in the photographs.
/// Where the work became less, store the new figure, so that it stays.
void expect_at_most(std::uint64_t count, std::uint64_t stored, const char* what) {
  EXPECT_GT(count, 0U) << what;
  EXPECT_LE(count, stored + stored / 100)
      << what << " does more work than before. If it is worth it, say so in the commit, and put " << count << " for "
      << stored << " in tests/engine/pipeline/work_guard_test.cc";
}

/// The synthetic temple, 8 views of 160 x 120, with the paper's depth step.
struct GuardedRun {
  RunReport report;
  std::size_t integrated_block_views = 0;
  std::uintmax_t bytes_written = 0;

  explicit GuardedRun(WindowModel model) {
    const TemporaryFolder folder;
    TempleOptions temple;
    temple.views = 8;
    temple.width = 160;
    Scene scene = make_temple_scene(temple);
    for (int index = 0; index < temple.views; ++index) {
      View& view = scene.views[static_cast<std::size_t>(index)];
      const ColorImage photograph = render_temple(scene, index, temple);
      view.image_path = folder.path() / view.image_path;
      write_png(view.image_path, photograph).value();
    }
    const Workspace workspace = Workspace::open(folder.path() / "result").value();
    RunOptions options;
    options.sweep.depth_step = 0.0025;
    options.sweep.threshold = 0.6F;
    options.sweep.window_model = model;
    CpuBackend cpu({SimdLevel::kBaseline, 64, 16});
    LimitedBackend counting(cpu, std::size_t{1} << 30);
    Progress progress;
    Run run{scene, options, counting, workspace, progress};
    reconstruct(run).value();
    report = run.report;
    integrated_block_views = counting.integrated_block_views;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(workspace.folder()))
      if (entry.path().extension() == ".pfm" || entry.path().extension() == ".ply") bytes_written += entry.file_size();
  }
};

TEST(WorkGuard, ARunDoesNoMoreWorkThanItDid) {
  const GuardedRun run(WindowModel::kPlane);
  const SweepCounts& sweep = run.report.sweep;
  expect_at_most(sweep.sweep_windows, 4925276, "the first pass (windows: pixel · depth · neighbor)");
  expect_at_most(sweep.sweep_samples, 7967360, "the first pass (interpolated samples)");
  expect_at_most(sweep.refine_windows, 1333648, "the second pass (windows: pixel · depth · neighbor)");
  expect_at_most(sweep.refine_samples, 11146120, "the second pass (interpolated samples)");
  expect_at_most(run.report.blocks, 694, "collect_blocks (blocks of the volume)");
  expect_at_most(run.report.block_views, 4019, "collect_blocks (blocks of each view)");
  expect_at_most(run.integrated_block_views * kBlockVoxels, 2057728, "integrate (voxels visited)");
  expect_at_most(run.bytes_written, 4550841, "the workspace (bytes of depth maps and mesh)");
  EXPECT_EQ(run.integrated_block_views, run.report.block_views) << "integrate visits other blocks than are in sight";
}

TEST(WorkGuard, SlantedWindowsTryNoMorePlanesThanTheyDid) {
  const GuardedRun run(WindowModel::kSlanted);
  const SweepCounts& sweep = run.report.sweep;
  expect_at_most(sweep.refine_windows, 3450280, "refine_planes (windows: pixel · plane · neighbor)");
  expect_at_most(sweep.refine_samples, 83629850, "refine_planes (interpolated samples)");
}

}  // namespace
}  // namespace quorum
