#include "engine/pipeline/compute_depth_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "engine/depth/depth_planes.h"
#include "engine/depth/half_size.h"
#include "engine/depth/outside_planes.h"
#include "engine/depth/plane_moves.h"
#include "engine/depth/plane_warp.h"
#include "engine/depth/second_window.h"
#include "engine/depth/small_task.h"
#include "engine/io/image_store.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/view_loop.h"
#include "engine/scene/copies.h"
#include "engine/volume/depth_normals.h"

namespace quorum {
namespace {

/// What is read of a view, and what is written.
struct ReadView {
  SweepTask task;
  std::optional<SweepTask> outside;  ///< the coarse sweep before it
  std::vector<const View*> neighbors;
  std::string record;
};
struct MadeView {
  DepthMap map;
  std::string record;
  ViewReport report;
};

/// The depth map of a view: after a coarse sweep beyond the bounds, and then, where no depth was found, from images of
/// half the size and with the second window, each if it is asked for.
Expected<DepthMap> sweep_view(const View& view, const Bounds& bounds, ReadView& input, SmallImages& small,
                              Backend& backend) {
  SweepTask& task = input.task;
  if (input.outside) {
    QUORUM_ASSIGN(const DepthMap found, backend.sweep_depth(*input.outside));
    task.outside = outside_planes(*input.outside, found, view, bounds);
  }
  auto map = backend.sweep_depth(task);
  if (!map) return map;
  if (task.options.half_size && has_small_images(task)) {
    const SweepTask half = make_half_task(task, *map, view, input.neighbors, small);
    QUORUM_ASSIGN(const DepthMap found, backend.sweep_depth(half));
    take_from_half(task, half, found, *map);
  }
  if (task.options.second_window > 0) {
    QUORUM_ASSIGN(const DepthMap found, backend.sweep_depth(make_second_task(task, *map)));
    take_missing(found, *map);
  }
  return map;
}

ViewReport report_view(const Scene& scene, int reference, const std::vector<int>& neighbors, const SweepTask& task,
                       const DepthMap& map) {
  ViewReport report;
  report.name = scene.views[reference].name;
  for (const int neighbor : neighbors) report.neighbors.push_back(scene.views[neighbor].name);
  for (const PlaneRange& range : task.ranges.values) {
    if (range.first > range.last) continue;
    ++report.swept_pixels;
    report.depth_samples += (range.last - range.first) / static_cast<uint>(task.planes.refinement) + 1;
  }
  report.valid_pixels = static_cast<std::uint64_t>(
      std::count_if(map.depth.values.begin(), map.depth.values.end(), [](float depth) { return depth > 0.0F; }));
  return report;
}

/// Why a view gets no depth map.
std::string why_left_out(const Run& run, int view, std::size_t neighbor_count) {
  const SelectViewsOptions& options = run.options.views;
  if (is_copy(run.scene, view)) return "repeats an earlier photograph, from its place";
  const bool by_angle = options.rule == ViewRule::kAngle || run.scene.points.empty();
  return fmt::format(
      "has {} neighbor views{}, needs 2", neighbor_count,
      by_angle ? fmt::format(" within {} to {} degrees", options.min_angle_deg, options.max_angle_deg) : "");
}

/// The neighbors of each view that the run works on; none of those that have too few, which are noted, and what is left
/// of whose depth maps is removed.
std::vector<std::vector<int>> choose_neighbors(Run& run) {
  std::vector<std::vector<int>> chosen(run.scene.views.size());
  for (int index = 0; index < static_cast<int>(chosen.size()); ++index) {
    if (run.options.shard && !run.options.shard->has(index)) continue;
    std::vector<int>& neighbors = chosen[static_cast<std::size_t>(index)];
    neighbors = select_views(run.scene, index, run.options.views);
    if (neighbors.size() >= kLeastNeighbors) continue;
    const std::string& name = run.view(index).name;
    run.workspace.remove_depth_map(name);
    run.progress.note(fmt::format("{}: {}; left out", name, why_left_out(run, index, neighbors.size())));
    neighbors.clear();
  }
  return chosen;
}

/// The views that have neighbors and no depth map yet that was made of the same. Others are counted as kept.
Expected<std::vector<int>> find_missing(Run& run, const std::vector<std::vector<int>>& neighbors,
                                        Provenance& provenance) {
  const StageTimer timer(run.report, "find_kept");
  int there = 0;
  std::vector<int> missing;
  for (int view = 0; view < static_cast<int>(neighbors.size()); ++view) {
    const std::vector<int>& others = neighbors[static_cast<std::size_t>(view)];
    if (others.empty()) continue;
    const std::string& name = run.view(view).name;
    if (run.workspace.has_depth_map(name) && run.workspace.has_maps(name, run.options.saved_files())) {
      QUORUM_ASSIGN(const std::string record, provenance.depth_record(view, others));
      if (run.workspace.depth_record(name) == record) {
        ++there;
        continue;
      }
    }
    missing.push_back(view);
  }
  if (missing.empty() && there == 0 && !run.options.shard)
    return std::unexpected(no_neighbors_error(run.scene, run.options.views));
  // Without those that this run made before its device was lost.
  run.report.kept_depth_maps = there - static_cast<int>(run.report.views.size());
  if (run.report.kept_depth_maps > 0)
    run.progress.note(
        fmt::format("{} depth maps of the same photographs, cameras and options are kept", run.report.kept_depth_maps));
  return missing;
}

}  // namespace

Expected<SweepTask> make_sweep_task(const Scene& scene, int reference, const std::vector<int>& neighbors,
                                    const SweepOptions& options, ImageStore& images) {
  SweepTask task;
  task.options = options;
  QUORUM_ASSIGN(auto planes, make_depth_planes(scene, reference, neighbors, options));
  task.planes = std::move(planes);
  QUORUM_ASSIGN(auto mask, images.mask(reference));
  task.intrinsics = scene.views[reference].camera.intrinsics;
  task.max_tilt = max_plane_tilt(scene.views[reference].camera);
  task.ranges = make_plane_ranges(scene.views[reference], scene.bounds, *mask, task.planes, options.window / 2);
  QUORUM_ASSIGN(auto image, images.padded(reference));
  task.reference = std::move(image);
  for (const int neighbor : neighbors) {
    QUORUM_ASSIGN(auto other, images.padded(neighbor));
    task.neighbors.push_back(std::move(other));
    task.warps.push_back(make_plane_warp(scene.views[reference].camera, scene.views[neighbor].camera));
  }
  return task;
}

Expected<void> check_depth_map_is_there(const Run& run, int index) {
  const std::string& name = run.view(index).name;
  if (run.workspace.has_depth_map(name) || select_views(run.scene, index, run.options.views).size() < kLeastNeighbors)
    return {};
  return failure(ErrorKind::kInput, fmt::format("{}: the depth map of {} is missing; run the shard of `quorum depth` "
                                                "that makes it, or all again: what is there is kept",
                                                run.workspace.folder().string(), name));
}

Expected<void> compute_depth_maps(Run& run) {
  const MemoryEstimate least = depth_map_memory(run.scene, run.options, run.backend);
  QUORUM_TRY(run.require(least, "computing depth maps"));
  const MemoryEstimate each_more = depth_map_in_flight_memory(run.scene, run.options, run.backend);
  const ViewsInFlight in_flight = views_in_flight(run, least, each_more);
  const std::uint64_t taken = least.total() + (in_flight.count - 1) * each_more.total();
  ImageStore images(run.scene, std::max(run.budget.left(), taken) - taken, run.options.mask_below);
  const std::vector<std::vector<int>> neighbors = choose_neighbors(run);
  const auto neighbors_of = [&](int view) -> const std::vector<int>& {
    return neighbors[static_cast<std::size_t>(view)];
  };
  Provenance provenance(run);
  QUORUM_ASSIGN(const std::vector<int> missing, find_missing(run, neighbors, provenance));
  if (missing.empty()) return {};
  run.workspace.remove_mesh();
  run.workspace.remove_cloud();
  for (const char* stage : {"confirm", "fuse"}) run.workspace.remove_shards(stage);
  run.progress.stage("computing depth maps", static_cast<int>(missing.size()));
  SmallImages small;
  std::mutex provenance_mutex;  // several views are read at the same time
  const auto read = [&](int view) -> Expected<ReadView> {
    QUORUM_ASSIGN(SweepTask task, make_sweep_task(run.scene, view, neighbors_of(view), run.options.sweep, images));
    const auto made_of = [&] {
      const std::lock_guard lock(provenance_mutex);
      return provenance.depth_record(view, neighbors_of(view));
    };
    QUORUM_ASSIGN(std::string record, made_of());
    std::vector<const View*> others;
    for (const int neighbor : neighbors_of(view)) others.push_back(&run.scene.views[neighbor]);
    std::optional<SweepTask> outside;
    if (run.options.sweep.outside && has_small_images(task))
      outside = make_outside_task(task, run.view(view), others, run.scene.bounds, small);
    return ReadView{std::move(task), std::move(outside), std::move(others), std::move(record)};
  };
  const auto sweep = [&](int view, ReadView& input) -> Expected<MadeView> {
    run.workspace.remove_depth_map(run.view(view).name);
    QUORUM_ASSIGN(DepthMap map, sweep_view(run.view(view), run.scene.bounds, input, small, run.backend));
    if (map.normal.empty()) map.normal = depth_normals(map.depth, run.view(view).camera);
    ViewReport report = report_view(run.scene, view, neighbors_of(view), input.task, map);
    return MadeView{std::move(map), input.record, std::move(report)};
  };
  const auto tell = [&](int, const MadeView& made) { run.report.views.push_back(made.report); };
  const auto save = [&](int view, const MadeView& made) {
    return run.workspace.save_depth_map(run.view(view).name, made.map, made.record, run.options.saved_files());
  };
  return for_each_view(run, missing, {"load_images", "sweep_depth", "save_depth_maps"}, read, sweep, save, in_flight,
                       tell);
}

}  // namespace quorum
