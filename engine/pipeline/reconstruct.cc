#include "engine/pipeline/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/clock.h"
#include "engine/core/memory.h"
#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/filled_patches.h"
#include "engine/mesh/make_manifold.h"
#include "engine/pipeline/colmap_workspace.h"
#include "engine/pipeline/compute_depth_maps.h"
#include "engine/pipeline/confirm_views.h"
#include "engine/pipeline/fuse_points.h"
#include "engine/pipeline/fuse_shards.h"
#include "engine/pipeline/fuse_views.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/run_json.h"
#include "engine/pipeline/write_model.h"

namespace quorum {
namespace {

const char* stage_name(const RunSteps& steps) { return steps.depth_maps ? "depth" : steps.mesh ? "fuse" : "confirm"; }

std::filesystem::path report_path(const Run& run, const RunSteps& steps) {
  const std::optional<Shard>& shard = run.options.shard;
  return shard ? run.workspace.shard_path(stage_name(steps), *shard, "json") : run.workspace.report_path();
}

/// Options that only the last step has a use for.
Expected<void> check_shard(const RunOptions& options) {
  const auto last = [](const RunOptions& of) { return options_json(of, RunStage::kClean, RunStage::kExtras); };
  if (!options.shard || last(options) == last(RunOptions())) return {};
  return failure(ErrorKind::kUsage, fmt::format("{} {}: options of the mesh and of files beside it belong to the last "
                                                "step; give them to `quorum join`",
                                                option_name("shard"), options.shard->text()));
}

/// What can be said before any work: options, the grid of the volume, places to write to.
Expected<void> check_before(Run& run, const RunSteps& steps) {
  QUORUM_TRY(run.options.check());
  QUORUM_TRY(check_shard(run.options));
  if (steps.mesh) {
    QUORUM_ASSIGN(const VoxelGrid grid, make_voxel_grid(run.scene, run.options.fusion));
    if (grid.is_coarse)
      run.progress.note(
          fmt::format("voxels of {:.4g} are coarser than the pixels, for the bounds would hold too many; "
                      "give smaller {}",
                      grid.voxel_size, option_name("bounds")));
    run.budget.foresee(least_run_bytes(run.scene, run.options, run.backend, grid));
    QUORUM_TRY(check_writable(run.workspace.mesh_path()));
  }
  if (steps.mesh && run.options.has_model()) QUORUM_TRY(check_writable(run.workspace.model_path()));
  if (run.options.cloud) QUORUM_TRY(check_writable(run.workspace.cloud_path()));
  if (run.options.colmap) QUORUM_TRY(check_colmap_workspace(run));
  return check_writable(report_path(run, steps));
}

void tell_absent_depth_maps(Run& run, const std::vector<int>& views) {
  std::vector<std::string> absent;
  for (int index = 0; index < static_cast<int>(run.scene.views.size()); ++index)
    if (!std::ranges::binary_search(views, index)) absent.push_back(run.view(index).name);
  if (absent.empty()) return;
  constexpr std::size_t kTold = 5;
  const auto end = absent.begin() + static_cast<std::ptrdiff_t>(std::min(absent.size(), kTold));
  run.progress.note(fmt::format("{} of {} views have no depth map here and take no part: {}{}", absent.size(),
                                run.scene.views.size(), fmt::join(absent.begin(), end, ", "),
                                absent.size() > kTold ? " …" : ""));
}

Expected<void> check_depth_maps(Run& run) {
  const StageTimer timer(run.report, "check_depth_maps");
  QUORUM_ASSIGN(const auto views, run.views_with_depth_map());
  tell_absent_depth_maps(run, views);
  return Provenance(run).check_depth_maps(views);
}

/// So that none stands beside a run that fails.
void remove_old_results(const Run& run, const RunSteps& steps) {
  run.workspace.remove_report();
  remove_file(report_path(run, steps));
  if (!run.options.shard && !steps.joins)  // what shards left is of no use to a run that makes it anew
    for (const char* stage : {"depth", "confirm", "fuse"}) run.workspace.remove_shards(stage);
  if (steps.mesh) {
    run.workspace.remove_mesh();
    run.workspace.remove_model();
  }
  if (run.options.cloud) run.workspace.remove_cloud();
}

void clean_mesh(Run& run, Mesh& mesh) {
  const StageTimer timer(run.report, "clean");
  run.report.extracted_triangles = mesh.triangles.size();
  CleanOptions rules = run.options.clean;
  // What is left after filling is confident enough, or filled in, with confidence 0.
  rules.min_confidence = run.options.fusion.fill_holes ? 0.0F : least_confidence(run, mesh.vertices);
  mesh = make_manifold(clean(mesh, rules));
  rules.min_confidence = 0.0F;
  mesh = clean(mesh, rules);  // once more: pieces that only touched are pieces of their own now
  run.report.filled_vertices =
      run.options.fusion.fill_holes ? static_cast<std::uint64_t>(std::ranges::count_if(mesh.vertices, is_filled)) : 0;
  run.report.vertices = mesh.vertices.size();
  run.report.triangles = mesh.triangles.size();
  run.report.pieces = count_pieces(mesh);
}

Expected<void> save_mesh(Run& run, const Mesh& mesh) {
  const StageTimer timer(run.report, "save_mesh");
  QUORUM_TRY(write_ply(run.workspace.mesh_path(), mesh, run.options.frame));
  run.progress.step();
  return {};
}

Expected<void> confirm(Run& run) {
  QUORUM_ASSIGN(const auto views, run.views_with_depth_map());
  return confirm_views(run, views);
}

Expected<void> make_mesh(Run& run, const RunSteps& steps) {
  QUORUM_ASSIGN(const auto views, run.views_with_depth_map());
  if (run.options.shard) return fuse_shard(run, views);
  QUORUM_ASSIGN(Mesh mesh, steps.joins ? join_shards(run, views) : fuse_views(run, views));
  clean_mesh(run, mesh);
  mesh.offset = run.scene.offset;
  QUORUM_TRY(save_mesh(run, mesh));
  return run.options.has_model() && !mesh.triangles.empty() ? write_model(run, mesh) : Expected<void>();
}

Expected<void> do_steps(Run& run, const RunSteps& steps) {
  if (steps.depth_maps) QUORUM_TRY(compute_depth_maps(run));
  if (steps.certainties && !(steps.mesh && run.options.shard)) QUORUM_TRY(confirm(run));
  if (steps.mesh) QUORUM_TRY(make_mesh(run, steps));
  if (run.options.cloud) QUORUM_TRY(write_cloud(run));
  if (run.options.colmap) QUORUM_TRY(write_colmap_workspace(run));
  return {};
}

/// A device that fails is made anew once. The steps find what is finished in the workspace, view by view.
Expected<void> do_steps_or_renew(Run& run, const RunSteps& steps) {
  const auto done = do_steps(run, steps);
  if (done || done.error().kind != ErrorKind::kDevice || !run.backend.renew()) return done;
  run.progress.note(done.error().message + "; it is made anew, and the run goes on from the last finished view");
  const auto again = do_steps(run, steps);
  if (again || again.error().kind != ErrorKind::kDevice) return again;
  return failure(
      ErrorKind::kDevice,
      fmt::format("{} (the second time); what is finished is kept: the same command goes on from there, also "
                  "with {} cpu",
                  again.error().message, option_name("device")));
}

}  // namespace

Expected<void> reconstruct(Run& run, const RunSteps& steps) {
  const double wall_start = wall_seconds();
  const double cpu_start = process_cpu_seconds();
  run.report.device = run.backend.description();
  QUORUM_TRY(check_before(run, steps));
  if (!steps.depth_maps) QUORUM_TRY(check_depth_maps(run));
  remove_old_results(run, steps);
  QUORUM_TRY(do_steps_or_renew(run, steps));
  run.report.kernels = run.backend.kernel_times();
  run.report.sweep = run.backend.sweep_counts();
  run.report.device_work = run.backend.device_work();
  run.report.wall_seconds += wall_seconds() - wall_start;
  run.report.cpu_seconds += process_cpu_seconds() - cpu_start;
  run.report.peak_memory_bytes = peak_memory_bytes();
  return write_file(report_path(run, steps), run_json(run));
}

}  // namespace quorum
