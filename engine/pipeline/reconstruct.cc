#include "engine/pipeline/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/depth/depth_planes.h"
#include "engine/depth/plane_warp.h"
#include "engine/io/image_store.h"
#include "engine/io/ply.h"
#include "engine/mesh/marching_cubes.h"

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

/// Merges the views into the volume and reads it back.
Expected<BlockPool> fill_volume(const Scene& scene, const std::vector<int>& views, const ReconstructOptions& options,
                                const VoxelGrid& grid, Backend& backend, const Workspace& workspace, ImageStore& images,
                                Progress& progress, RunReport& report) {
  const auto with_view = [&](int index, auto use) -> Expected<void> {
    if (progress.stop_requested()) return std::unexpected(stopped());
    const View& view = view_at(scene, index);
    auto map = workspace.load_depth_map(view.name, view.width, view.height);
    if (!map) return std::unexpected(map.error());
    auto image = load_padded(images, index);
    if (!image) return std::unexpected(image.error());
    auto used = use(FusionView{*map, **image, view.camera});
    progress.step();
    return used;
  };

  if (auto begun = backend.begin_volume(grid, options.fusion); !begun) return std::unexpected(begun.error());
  std::vector<std::vector<std::uint32_t>> blocks_of_view;
  std::vector<std::uint32_t> all_blocks;
  {
    const StageTimer timer(report, "collect_blocks");
    progress.stage("finding voxel blocks", static_cast<int>(views.size()));
    for (const int index : views) {
      auto collected = with_view(index, [&](const FusionView& view) -> Expected<void> {
        auto blocks = backend.collect_blocks(view);
        if (!blocks) return std::unexpected(blocks.error());
        std::vector<std::uint32_t> merged;
        merged.reserve(all_blocks.size() + blocks->size());
        std::set_union(all_blocks.begin(), all_blocks.end(), blocks->begin(), blocks->end(),
                       std::back_inserter(merged));
        all_blocks = std::move(merged);
        report.block_views += blocks->size();
        blocks_of_view.push_back(std::move(*blocks));
        return {};
      });
      if (!collected) return std::unexpected(collected.error());
    }
  }
  report.blocks = all_blocks.size();

  {
    const StageTimer timer(report, "integrate");
    progress.stage("merging depth maps", static_cast<int>(views.size()));
    if (auto allocated = backend.allocate_blocks(std::move(all_blocks)); !allocated)
      return std::unexpected(allocated.error());
    for (std::size_t i = 0; i < views.size(); ++i) {
      auto integrated =
          with_view(views[i], [&](const FusionView& view) { return backend.integrate(view, blocks_of_view[i]); });
      if (!integrated) return std::unexpected(integrated.error());
    }
  }
  const StageTimer timer(report, "read_blocks");
  return backend.read_blocks();
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
  constexpr std::size_t kLeastNeighbors = 2;  // the paper, 4.3: every point is seen in at least three views
  ImageStore images(scene, options.image_cache_bytes, options.mask_below);
  progress.stage("computing depth maps", static_cast<int>(scene.views.size()));
  for (int reference = 0; reference < static_cast<int>(scene.views.size()); ++reference) {
    if (progress.stop_requested()) return std::unexpected(stopped());
    const std::string& name = view_at(scene, reference).name;
    const std::vector<int> neighbors = select_views(scene, reference, options.views);
    workspace.remove_depth_map(name);
    if (neighbors.size() < kLeastNeighbors) {
      progress.note(fmt::format("{}: has {} neighbor views within {} to {} degrees, needs 2; left out", name,
                                neighbors.size(), options.views.min_angle_deg, options.views.max_angle_deg));
      progress.step();
      continue;
    }
    Expected<SweepTask> task = failure(ErrorKind::kInput, "");
    {
      const StageTimer timer(report, "load_images");
      task = make_sweep_task(scene, reference, neighbors, options.sweep, images);
    }
    if (!task) return std::unexpected(task.error());
    Expected<DepthMap> map = failure(ErrorKind::kInput, "");
    {
      const StageTimer timer(report, "sweep_depth");
      map = backend.sweep_depth(*task);
    }
    if (!map) return std::unexpected(map.error().within(name));
    report.views.push_back(report_view(scene, reference, neighbors, *task, *map));
    const StageTimer timer(report, "save_depth_maps");
    if (auto saved = workspace.save_depth_map(name, *map); !saved) return saved;
    progress.step();
  }
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

  ImageStore images(scene, options.image_cache_bytes, 0.0);
  auto pool = fill_volume(scene, views, options, *grid, backend, workspace, images, progress, report);
  if (!pool) return std::unexpected(pool.error());

  progress.stage("extracting the mesh", 1);
  Mesh mesh;
  {
    const StageTimer timer(report, "marching_cubes");
    mesh = marching_cubes(*pool, *grid);
    *pool = {};
    report.extracted_triangles = mesh.triangles.size();
  }
  {
    const StageTimer timer(report, "clean");
    CleanOptions rules = options.clean;
    if (options.automatic_confidence) rules.min_confidence = automatic_min_confidence(mesh);
    report.min_confidence = rules.min_confidence;
    mesh = clean(mesh, rules);
  }
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
