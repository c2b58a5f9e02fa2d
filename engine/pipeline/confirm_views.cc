#include "engine/pipeline/confirm_views.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/mesh/drop_specks.h"
#include "engine/pipeline/compute_depth_maps.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/view_loop.h"
#include "engine/volume/range_surface.h"

namespace quorum {
namespace {

/// A patch of more is no speck however small the image: else small images would lose all.
int most_speck_pixels(const Grid<float>& depth) { return static_cast<int>(depth.values.size() / 1500); }

/// The other views that a view may be compared with.
std::vector<int> select_candidates(const Run& run, int view) {
  SelectViewsOptions rule = run.options.views;
  rule.neighbor_count = kConfirmingViews;
  return select_views(run.scene, view, rule);
}

/// Those of them that it is compared with. views: with a depth map, ascending.
std::vector<int> select_others(const Run& run, int view, const std::vector<int>& views) {
  std::vector<int> others = select_candidates(run, view);
  std::erase_if(others, [&](int other) { return !std::ranges::binary_search(views, other); });
  return others;
}

Expected<ConfirmTask> read_task(const Run& run, int view, const std::vector<int>& others) {
  const auto read = [&](int index) -> Expected<ViewDepths> {
    const View& source = run.view(index);
    QUORUM_ASSIGN(auto depth, run.workspace.load_depth(source.name, source.width, source.height));
    return ViewDepths{std::move(depth), source.camera};
  };
  QUORUM_ASSIGN(auto depths, read(view));
  ConfirmTask task{std::move(depths), {}, run.options.fusion};
  for (const int other : others) {
    QUORUM_ASSIGN(auto other_depths, read(other));
    task.others.push_back(std::move(other_depths));
  }
  return task;
}

/// That no depth map is missing that the shard's views need.
Expected<void> check_inputs(const Run& run, const Shard& shard) {
  for (int view = 0; view < static_cast<int>(run.scene.views.size()); ++view) {
    if (!shard.has(view)) continue;
    QUORUM_TRY(check_depth_map_is_there(run, view));
    for (const int other : select_candidates(run, view)) QUORUM_TRY(check_depth_map_is_there(run, other));
  }
  return {};
}

}  // namespace

Expected<void> confirm_views(Run& run, const std::vector<int>& views) {
  if (!run.options.confirm) {
    for (const int view : views) run.workspace.remove_certainty(run.view(view).name);
    return {};
  }
  const std::optional<Shard>& shard = run.options.shard;
  if (shard) QUORUM_TRY(check_inputs(run, *shard));
  std::vector<std::vector<int>> others(run.scene.views.size());
  std::vector<std::string> records(run.scene.views.size());
  std::vector<int> missing;
  Provenance provenance(run);
  int own = 0;
  for (const int view : views) {
    if (shard && !shard->has(view)) continue;
    ++own;
    const auto place = static_cast<std::size_t>(view);
    others[place] = select_others(run, view, views);
    records[place] = provenance.certainty_record(view, others[place]);
    if (records[place].empty() || run.workspace.certainty_record(run.view(view).name) != records[place])
      missing.push_back(view);
  }
  run.report.kept_certainties = own - static_cast<int>(missing.size());
  if (missing.empty()) return {};
  QUORUM_TRY(run.require(confirm_memory(run.scene, views, run.backend), "confirming depths"));
  run.progress.stage("confirming depths", static_cast<int>(missing.size()));
  const auto read = [&](int view) { return read_task(run, view, others[static_cast<std::size_t>(view)]); };
  const auto confirm = [&](int, const ConfirmTask& task) -> Expected<Grid<float>> {
    const Grid<float>& depth = task.view.depth;
    QUORUM_ASSIGN(Grid<float> certainty, run.backend.confirm_depths(task));
    const float max_step = make_range_surface_params(task.view.camera, depth.width, depth.height, task.fusion).max_step;
    drop_specks(depth, max_step, std::min(run.options.min_patch, most_speck_pixels(depth)), certainty);
    return certainty;
  };
  const auto save = [&](int view, const Grid<float>& certainty) {
    return run.workspace.save_certainty(run.view(view).name, certainty, records[static_cast<std::size_t>(view)],
                                        run.options.previews);
  };
  return for_each_view(run, missing, {"load_depth_maps", "confirm_depths", "save_certainty"}, read, confirm, save);
}

Expected<void> check_certainties(const Run& run, const std::vector<int>& views) {
  for (int view = 0; view < static_cast<int>(run.scene.views.size()); ++view)
    QUORUM_TRY(check_depth_map_is_there(run, view));
  if (!run.options.confirm) return {};
  Provenance provenance(run);
  for (const int view : views) {
    const std::string& name = run.view(view).name;
    const std::string record = provenance.certainty_record(view, select_others(run, view, views));
    if (record.empty() || run.workspace.certainty_record(name) != record)
      return failure(ErrorKind::kInput,
                     fmt::format("{}: the certainty of {} is missing, or was made of other depth maps or options; run "
                                 "`quorum confirm` with the same options: what is there is kept",
                                 run.workspace.folder().string(), name));
  }
  return {};
}

}  // namespace quorum
