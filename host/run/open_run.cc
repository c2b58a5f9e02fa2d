#include "host/run/open_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/memory.h"
#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/pipeline/fuse_shards.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/workspace_lock.h"
#include "engine/report/report.h"
#include "host/run/open_backend.h"

namespace quorum {
namespace {

Expected<WorkspaceLock> take_lock(const Workspace& workspace, const std::string& command,
                                  const std::optional<Shard>& shard) {
  if (!shard) return WorkspaceLock::take(workspace.folder(), command);
  QUORUM_TRY(make_folder(workspace.folder() / "shards"));
  return WorkspaceLock::take_shard(workspace.folder(), command, *shard);
}

bool has_masks(const Run& run) {
  return run.options.mask_below > 0 ||
         std::ranges::any_of(run.scene.views, [](const View& view) { return !view.mask_path.empty(); });
}

/// Cameras that are not those of the photographs leave a few depths by chance, or many that don't fit each other.
void tell_few_depths(Run& run) {
  // With wrong focal lengths or poses 2 to 5 % were seen, with right ones 10 % and more. Tiny views tell neither: right
  // ones of 96 pixels had 5.5 %.
  constexpr double kFew = 0.06;
  constexpr double kTiny = 128 * 96;
  double pixels = 0;
  for (const View& view : run.scene.views) pixels += static_cast<double>(view.width) * view.height;
  if (pixels < kTiny * static_cast<double>(run.scene.views.size())) return;
  double swept = 0;
  double valid = 0;
  for (const ViewReport& view : run.report.views) {
    swept += static_cast<double>(view.swept_pixels);
    valid += static_cast<double>(view.valid_pixels);
  }
  if (valid < kFew * swept) {
    run.progress.note(
        fmt::format("only {:.1f} % of the pixels got a depth: check that the cameras belong to these photographs, take "
                    "more of them, or say where the object is ({}, {})",
                    100.0 * valid / swept, option_name("bounds"), option_name("masks")));
    return;
  }
  // Right cameras had 45 to 84 % where views stand 45 degrees apart or less, wrong focal lengths 10 to 25; a ring
  // with one half too long had 77.
  constexpr double kUnconfirmed = 0.3;
  const auto compared = static_cast<double>(run.report.compared_depths);
  const auto confirmed = static_cast<double>(run.report.confirmed_depths);
  if (confirmed < kUnconfirmed * compared)
    run.progress.note(fmt::format(
        "other views confirm only {:.0f} % of the depths: check that the cameras belong to these photographs, or take "
        "more of them",
        100.0 * confirmed / compared));
}

/// What would help, as far as the run shows it.
void tell_advice(Run& run) {
  tell_few_depths(run);
  const RunReport& report = run.report;
  const std::uint64_t dropped = report.extracted_triangles - report.triangles;
  if (!run.options.fusion.fill_holes && 10 * dropped > report.extracted_triangles)
    run.progress.note(fmt::format(
        "{:.0f} % of the surface was dropped as uncertain or small; {}more photographs helps where it frays, "
        "{} keeps more",
        100.0 * static_cast<double>(dropped) / static_cast<double>(report.extracted_triangles),
        has_masks(run) ? "" : fmt::format("a mask ({}, {}) or ", option_name("masks"), option_name("mask-below")),
        option_name("min-confidence")));
}

void tell_summary(Run& run, const RunSteps& steps) {
  const RunReport& report = run.report;
  if (steps.mesh && !run.options.shard)
    run.progress.note(fmt::format("{}: {} triangles, {} vertices, {} pieces, confidence {:.3g} and more",
                                  run.workspace.mesh_path().string(), report.triangles, report.vertices, report.pieces,
                                  report.min_confidence));
  if (steps.mesh && !run.options.shard) tell_advice(run);
  const std::uint64_t others = children_peak_memory_bytes();
  run.progress.note(fmt::format("{}: {:.1f} s, {:.1f} CPU s, {} MiB at most{}", run.workspace.folder().string(),
                                report.wall_seconds, report.cpu_seconds, peak_memory_bytes() >> 20,
                                others > 0 ? fmt::format(", colmap {} MiB", others >> 20) : ""));
}

}  // namespace

std::vector<StageWeight> expected_stages(const RunSteps& steps, bool is_shard) {
  std::vector<StageWeight> expected = run_stage_weights();
  std::erase_if(expected, [&](const StageWeight& stage) {
    if (stage.name == "computing depth maps") return !steps.depth_maps;
    if (stage.name == "confirming depths") return !steps.certainties || (steps.mesh && is_shard);
    if (stage.name == "extracting the mesh") return !steps.mesh || is_shard;
    return !steps.mesh || steps.joins;
  });
  return expected;
}

Expected<void> with_run(const Scene& scene, const RunRequest& request, Progress& progress, const RunSteps& steps,
                        const std::function<Expected<void>(Run&)>& work) {
  RunOptions options = request.options;
  QUORUM_TRY(options.check());
  const ThreadLimit limit(options.threads);
  QUORUM_ASSIGN(const auto backend, open_backend(options));
  QUORUM_ASSIGN(const Workspace workspace, Workspace::open(request.output));
  QUORUM_ASSIGN(const WorkspaceLock lock, take_lock(workspace, request.command, options.shard));
  if (request.takes_depth_options) QUORUM_TRY(take_depth_options(options, scene, workspace));
  if (request.takes_part_options) QUORUM_TRY(take_part_options(options, workspace));
  if (request.restart)
    for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
      if (!options.shard || options.shard->has(view))
        workspace.remove_depth_map(scene.views[static_cast<std::size_t>(view)].name);
  Run run{scene, options, *backend, workspace, progress};
  for (const std::string& note : scene.notes) progress.note(note);
  progress.note(fmt::format("{} views, on {}", scene.views.size(), backend->description()));
  const auto done = work(run);
  progress.finish();
  if (done) tell_summary(run, steps);
  return done;
}

Expected<void> make_results(Run& run, const RunRequest& request, const RunSteps& steps) {
  QUORUM_TRY(reconstruct(run, steps));
  if (steps.mesh && !run.options.shard && run.report.triangles == 0)
    return failure(ErrorKind::kInput,
                   fmt::format("{}: the mesh is empty: no surface was seen by enough views; check the cameras, "
                               "{}{} and {}",
                               run.workspace.mesh_path().string(), has_masks(run) ? "the masks, " : "",
                               option_name("bounds"), option_name("min-confidence")));
  return request.report ? write_report(run.scene, run.workspace, run.budget, run.progress) : Expected<void>();
}

}  // namespace quorum
