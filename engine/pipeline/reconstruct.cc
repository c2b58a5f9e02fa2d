#include "engine/pipeline/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/depth/depth_planes.h"
#include "engine/depth/plane_moves.h"
#include "engine/depth/plane_warp.h"
#include "engine/depth/second_window.h"
#include "engine/io/image_store.h"
#include "engine/io/ply.h"
#include "engine/mesh/fill_holes.h"
#include "engine/pipeline/background_thread.h"
#include "engine/pipeline/confirm_views.h"
#include "engine/pipeline/fuse_views.h"
#include "engine/volume/depth_normals.h"

namespace quorum {
namespace {

const View& view_at(const Scene& scene, int index) { return scene.views[static_cast<std::size_t>(index)]; }

Expected<std::shared_ptr<const PaddedImage>> load_padded(ImageStore& images, int view) {
  auto image = images.image(view);
  if (!image) return std::unexpected(image.error());
  return std::make_shared<const PaddedImage>(pad_image(**image));
}

/// Everything that the sweep of one reference view needs.
Expected<SweepTask> make_sweep_task(const Scene& scene, int reference, const std::vector<int>& neighbors,
                                    const SweepOptions& options, ImageStore& images) {
  SweepTask task;
  task.options = options;
  auto planes = make_depth_planes(scene, reference, neighbors, options);
  if (!planes) return std::unexpected(planes.error());
  task.planes = std::move(*planes);
  auto mask = images.mask(reference);
  if (!mask) return std::unexpected(mask.error());
  task.intrinsics = view_at(scene, reference).camera.intrinsics;
  task.max_tilt = max_plane_tilt(view_at(scene, reference).camera);
  task.ranges = make_plane_ranges(view_at(scene, reference), scene.bounds, **mask, task.planes, options.window / 2);
  auto image = load_padded(images, reference);
  if (!image) return std::unexpected(image.error());
  task.reference = std::move(*image);
  for (const int neighbor : neighbors) {
    auto other = load_padded(images, neighbor);
    if (!other) return std::unexpected(other.error());
    task.neighbors.push_back(std::move(*other));
    task.warps.push_back(make_plane_warp(view_at(scene, reference).camera, view_at(scene, neighbor).camera));
  }
  return task;
}

/// The depth map of a view, with the second window where it is asked for.
Expected<DepthMap> sweep_view(const SweepTask& task, Backend& backend) {
  auto map = backend.sweep_depth(task);
  if (!map || task.options.second_window == 0) return map;
  const auto second = backend.sweep_depth(make_second_task(task, *map));
  if (!second) return std::unexpected(second.error());
  take_missing(*second, *map);
  return map;
}

ViewReport report_view(const Scene& scene, int reference, const std::vector<int>& neighbors, const SweepTask& task,
                       const DepthMap& map) {
  ViewReport report;
  report.name = view_at(scene, reference).name;
  for (const int neighbor : neighbors) report.neighbors.push_back(view_at(scene, neighbor).name);
  for (const PlaneRange& range : task.ranges.values) {
    if (range.first > range.last) continue;
    ++report.swept_pixels;
    report.depth_samples += (range.last - range.first) / static_cast<uint>(task.planes.refinement) + 1;
  }
  report.valid_pixels = static_cast<std::uint64_t>(
      std::count_if(map.depth.values.begin(), map.depth.values.end(), [](float depth) { return depth > 0.0F; }));
  return report;
}

Error stopped() { return {ErrorKind::kStopped, "stopped as asked; finished depth maps are kept"}; }

/// A view whose depth map is to be computed.
struct ReferenceView {
  int index = 0;
  std::vector<int> neighbors;
};

/// The views that have enough neighbors. The others are noted, and what is left of their depth maps is removed.
std::vector<ReferenceView> choose_references(const Scene& scene, const SelectViewsOptions& options,
                                             const Workspace& workspace, Progress& progress) {
  constexpr std::size_t kLeastNeighbors = 2;  // the paper, 4.3: every point is seen in at least three views
  std::vector<ReferenceView> chosen;
  for (int index = 0; index < static_cast<int>(scene.views.size()); ++index) {
    std::vector<int> neighbors = select_views(scene, index, options);
    if (neighbors.size() >= kLeastNeighbors) {
      chosen.push_back({index, std::move(neighbors)});
      continue;
    }
    const std::string& name = view_at(scene, index).name;
    workspace.remove_depth_map(name);
    const bool by_angle = options.rule == ViewRule::kAngle || scene.points.empty();
    const std::string apart =
        by_angle ? fmt::format(" within {} to {} degrees", options.min_angle_deg, options.max_angle_deg) : "";
    progress.note(fmt::format("{}: has {} neighbor views{}, needs 2; left out", name, neighbors.size(), apart));
  }
  return chosen;
}

/// What the depth map of one view takes at most: its task and the next one's, which is read meanwhile, the sweep, and
/// the maps of the last view, which are written meanwhile.
std::uint64_t view_bytes(const Scene& scene, const ReconstructOptions& options, const Backend& backend) {
  // A pixel: four maps, a file's bytes, pictures; with a second window the first one's maps and the other's ranges.
  const std::uint64_t written_bytes = options.sweep.second_window == 0 ? 56 : 56 + 32;
  const auto neighbors = static_cast<std::uint64_t>(options.views.neighbor_count);
  const std::uint64_t task_bytes = 4 * (1 + neighbors) + 8 + 6;  // padded images, ranges; a photograph and its mask
  constexpr std::uint64_t kDistortedBytes = 12;                  // a pixel of a photograph: file, decoded, in color
  const auto area = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  std::uint64_t pixels = 0;
  std::uint64_t distorted_pixels = 0;
  for (const View& view : scene.views) {
    pixels = std::max(pixels, area(view.width, view.height));
    distorted_pixels = std::max(distorted_pixels, area(view.photo_width, view.photo_height));
  }
  return (2 * task_bytes + written_bytes) * pixels + kDistortedBytes * distorted_pixels +
         backend.view_bytes(pixels, options.views.neighbor_count);
}

}  // namespace

Expected<void> ReconstructOptions::check() const {
  for (const auto& result : {views.check(), sweep.check(), fusion.check(), clean.check()})
    if (!result) return result;
  if (!(mask_below >= 0.0 && mask_below < 1.0))
    return failure(ErrorKind::kUsage, fmt::format("--mask-below {}: give a level from 0 to 1", mask_below));
  if (sweep.min_votes > views.neighbor_count)
    return failure(ErrorKind::kUsage,
                   fmt::format("--min-votes {}: can't exceed --neighbors {}", sweep.min_votes, views.neighbor_count));
  return {};
}

Expected<void> compute_depth_maps(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                                  const Workspace& workspace, Progress& progress, RunReport& report) {
  const MemoryBudget budget(options.memory_bytes);
  report.memory_budget_bytes = budget.bytes();
  const std::uint64_t in_flight = view_bytes(scene, options, backend);
  if (auto fits = budget.require(in_flight, "computing depth maps"); !fits) return fits;
  ImageStore images(scene, std::max(budget.left(), in_flight) - in_flight, options.mask_below);
  const auto references = choose_references(scene, options.views, workspace, progress);
  progress.stage("computing depth maps", static_cast<int>(references.size()));

  // While one view is swept, the next one's photographs are read and the last one's maps are written.
  BackgroundThread reader;
  BackgroundThread writer;
  const auto read = [&](std::size_t place) {
    return reader.run([&scene, &options, &images, view = references[place]] {
      return make_sweep_task(scene, view.index, view.neighbors, options.sweep, images);
    });
  };
  std::future<Expected<SweepTask>> reading;
  if (!references.empty()) reading = read(0);
  std::future<Expected<void>> writing = writer.run([] { return Expected<void>(); });
  for (std::size_t place = 0; place < references.size(); ++place) {
    if (progress.stop_requested()) return std::unexpected(stopped());
    const auto& [reference, neighbors] = references[place];
    const std::string& name = view_at(scene, reference).name;
    workspace.remove_depth_map(name);
    const Expected<SweepTask> task = reading.get();
    if (place + 1 < references.size()) reading = read(place + 1);
    if (!task) return std::unexpected(task.error());
    Expected<DepthMap> map = failure(ErrorKind::kInput, "");
    {
      const StageTimer timer(report, "sweep_depth");
      map = sweep_view(*task, backend);
    }
    if (!map) return std::unexpected(map.error().within(name));
    if (map->normal.empty()) map->normal = depth_normals(map->depth, view_at(scene, reference).camera);
    report.views.push_back(report_view(scene, reference, neighbors, *task, *map));
    if (auto saved = writing.get(); !saved) return saved;
    writing = writer.run([&workspace, &name, map = std::move(*map)] { return workspace.save_depth_map(name, map); });
    progress.step();
  }
  if (auto saved = writing.get(); !saved) return saved;
  add_stage(report, reader.time("load_images"));
  add_stage(report, writer.time("save_depth_maps"));
  report.kernels = backend.kernel_times();
  report.sweep = backend.sweep_counts();
  if (report.views.empty())
    return failure(ErrorKind::kInput,
                   "no view has two neighbor views; give photographs taken from closer directions, or --max-angle");
  return {};
}

Expected<void> fuse_depth_maps(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                               const Workspace& workspace, Progress& progress, RunReport& report) {
  std::vector<int> views;
  for (int index = 0; index < static_cast<int>(scene.views.size()); ++index)
    if (workspace.has_depth_map(view_at(scene, index).name)) views.push_back(index);
  if (views.empty())
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depth map of this scene; run `quorum depth` first",
                                                  (workspace.folder() / "depth").string()));
  if (views.size() > static_cast<std::size_t>(kMaxIntegratedViews))
    return failure(ErrorKind::kInput, fmt::format("{} views are more than the {} that one volume takes", views.size(),
                                                  kMaxIntegratedViews));
  const auto grid = make_voxel_grid(scene, options.fusion);
  if (!grid) return std::unexpected(grid.error());
  report.voxel_size = grid->voxel_size;
  report.truncation = grid->truncation;

  if (options.confirm) {
    if (auto confirmed = confirm_views(scene, views, options, backend, workspace, progress, report); !confirmed)
      return confirmed;
  } else {
    for (const int view : views) workspace.remove_certainty(view_at(scene, view).name);
  }
  const MemoryBudget budget(options.memory_bytes);
  report.memory_budget_bytes = budget.bytes();
  // A slab takes each photograph once, and the memory is better spent on large slabs.
  ImageStore images(scene, 0, options.mask_below);
  FusionInput input{scene,   views,  *grid,    options.fusion, workspace,       budget,
                    backend, images, progress, report,         options.confirm, {}};
  const auto min_confidence = [&](const std::vector<Vertex>& vertices) {
    constexpr float kConfirmed = 0.035F;  // docs/quality.md; without confirmation the default
    report.min_confidence = !options.automatic_confidence ? options.clean.min_confidence
                            : options.confirm             ? automatic_min_confidence(vertices, kConfirmed)
                                                          : automatic_min_confidence(vertices);
    return report.min_confidence;
  };
  input.min_confidence = min_confidence;
  auto extracted = fuse_views(input);
  if (!extracted) return std::unexpected(extracted.error());
  Mesh mesh = std::move(*extracted);
  report.extracted_triangles = mesh.triangles.size();
  {
    const StageTimer timer(report, "clean");
    CleanOptions rules = options.clean;
    // What is left after filling is confident enough, or filled in, with confidence 0.
    rules.min_confidence = options.fusion.fill_holes ? 0.0F : min_confidence(mesh.vertices);
    mesh = clean(mesh, rules);
  }
  report.filled_vertices =
      options.fusion.fill_holes ? static_cast<std::uint64_t>(std::ranges::count_if(mesh.vertices, is_filled)) : 0;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  if (mesh.triangles.empty())
    progress.note("the mesh is empty: no surface was seen by enough views; check bounds, cameras and --min-confidence");
  const StageTimer timer(report, "save_mesh");
  auto saved = write_ply(workspace.mesh_path(), mesh);
  progress.step();
  report.kernels = backend.kernel_times();
  return saved;
}

}  // namespace quorum
