#include "engine/pipeline/plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/depth/depth_planes.h"
#include "engine/depth/half_size.h"
#include "engine/depth/second_window.h"
#include "engine/depth/small_task.h"
#include "engine/pipeline/compute_depth_maps.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/memory_estimates.h"
#include "engine/scene/limit_image_size.h"

namespace quorum {
namespace {

// CPU seconds beside the sweep, measured on scenes of 2 to 15 megapixels (docs/cluster.md).
constexpr double kSaveSeconds = 0.32e-6;     // a pixel, its photograph read, its maps written
constexpr double kConfirmSeconds = 0.19e-6;  // a pixel
constexpr double kCollectSeconds = 0.12e-6;  // a pixel
constexpr double kMergeSeconds = 0.2e-6;     // a pixel
constexpr double kMeshSeconds = 0.9e-6;      // a triangle
constexpr double kDepthMapBytes = 31.0;      // a pixel
constexpr double kFileVertexBytes = 35.0;
constexpr double kTriangleBytes = 13.0;

/// What the sweep of a few views asks for and takes.
struct ViewSample {
  double pixels = 0.0;
  double swept = 0.0;          // pixels
  double samples = 0.0;        // of depth, over the swept pixels
  double sweep_windows = 0.0;  // of the small images
  double refine_pixels = 0.0;  // pixel · neighbor, of the small images
  double sweep_seconds = 0.0;
  double refine_seconds = 0.0;
  // Of both passes, and of the step with images of half the size: a share that large images have, too.
  double windows = 0.0;
  double half_windows = 0.0;

  [[nodiscard]] double half_share() const { return windows > 0 ? half_windows / windows : 0.0; }
  [[nodiscard]] double seconds_per_window() const { return sweep_windows > 0 ? sweep_seconds / sweep_windows : 0.0; }
  [[nodiscard]] double seconds_per_refinement() const {
    return refine_pixels > 0 ? refine_seconds / refine_pixels : 0.0;
  }
};

double windows_of(const SweepCounts& counts) {
  return static_cast<double>(counts.sweep_windows) + static_cast<double>(counts.refine_windows);
}

/// Adds what images of half the size take of the view. backend: has made the map of the task.
Expected<void> sample_half_size(const Scene& small, int view, const std::vector<int>& neighbors, const SweepTask& task,
                                const DepthMap& map, CpuBackend& backend, ViewSample& sample) {
  const double before = windows_of(backend.sweep_counts());
  sample.windows += before;
  if (!task.options.half_size || !has_small_images(task)) return {};
  std::vector<const View*> others;
  for (const int neighbor : neighbors) others.push_back(&small.views[static_cast<std::size_t>(neighbor)]);
  SmallImages images;
  const View& reference = small.views[static_cast<std::size_t>(view)];
  QUORUM_TRY(backend.sweep_depth(make_half_task(task, map, reference, others, images)));
  sample.half_windows += windows_of(backend.sweep_counts()) - before;
  return {};
}

/// Adds one view. small: the scene with small images.
Expected<void> sample_view(const Scene& scene, const Scene& small, int view, const std::vector<int>& neighbors,
                           const RunOptions& options, ViewSample& sample) {
  CpuBackend backend({options.simd.value_or(best_simd_level()), options.tile_width, options.tile_height});
  ImageStore images(small, 0, options.mask_below);
  QUORUM_ASSIGN(const SweepTask task, make_sweep_task(small, view, neighbors, options.sweep, images));
  QUORUM_ASSIGN(const DepthPlanes planes, make_depth_planes(scene, view, neighbors, options.sweep));
  QUORUM_ASSIGN(const DepthMap map, backend.sweep_depth(task));
  const auto pixels = [view](const Scene& of) {
    const View& at = of.views[static_cast<std::size_t>(view)];
    return static_cast<double>(at.width) * at.height;
  };
  // The same rays, in more pixels and more steps.
  const double steps = static_cast<double>(planes.depth.size()) / planes.refinement /
                       (static_cast<double>(task.planes.depth.size()) / task.planes.refinement);
  const double factor = pixels(scene) / pixels(small);
  double swept = 0.0;
  for (const PlaneRange& range : task.ranges.values) {
    if (range.first > range.last) continue;
    ++swept;
    sample.samples +=
        factor * steps * ((range.last - range.first) / static_cast<std::uint32_t>(task.planes.refinement) + 1);
  }
  sample.pixels += pixels(scene);
  sample.swept += factor * swept;
  sample.refine_pixels += swept * static_cast<double>(neighbors.size());
  sample.sweep_windows += static_cast<double>(backend.sweep_counts().sweep_windows);
  for (const StageTime& time : backend.kernel_times())
    (time.name == "sweep_depth" ? sample.sweep_seconds : sample.refine_seconds) += time.seconds;
  return sample_half_size(small, view, neighbors, task, map, backend, sample);
}

Expected<ViewSample> sample_views(const Scene& scene, const std::vector<int>& views,
                                  const std::vector<std::vector<int>>& neighbors, const RunOptions& options) {
  constexpr int kSmallSide = 320;  // pixels
  constexpr std::size_t kSamples = 3;
  Scene small = scene;
  limit_image_size(small, kSmallSide);
  ViewSample sample;
  const std::size_t count = std::min(kSamples, views.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int view = views[(2 * i + 1) * views.size() / (2 * count)];
    QUORUM_TRY(sample_view(scene, small, view, neighbors[static_cast<std::size_t>(view)], options, sample));
  }
  return sample;
}

void add_memory(const Scene& scene, const RunOptions& options, Plan& plan) {
  constexpr std::uint64_t kProgram = 64 << 20;  // held before any work
  const CpuBackend backend(CpuSweepOptions{});
  const SurfaceEstimate surface = estimate_surface(scene, plan.grid);
  plan.blocks = surface.blocks;
  plan.triangles = surface.triangles;
  plan.least_memory = kProgram + least_run_bytes(scene, options, backend, plan.grid);
  const std::uint64_t block = kBlockVoxels * sizeof(Voxel) + block_surface_bytes(options.fusion);
  plan.full_memory = std::max(plan.least_memory, kProgram + surface.blocks * block + sizeof(Vertex) * surface.vertices +
                                                     backend.view_bytes(1, 0));
  plan.disk = static_cast<std::uint64_t>(kDepthMapBytes * static_cast<double>(plan.pixels) +
                                         kFileVertexBytes * static_cast<double>(surface.vertices) +
                                         kTriangleBytes * static_cast<double>(surface.triangles));
}

}  // namespace

double Plan::seconds(int shards, int threads) const {
  const double divided = depth_seconds + confirm_seconds + merge_seconds;
  return (divided / shards + collect_seconds + join_seconds) / threads;
}

int Plan::shards(double most_seconds, int threads) const {
  for (int count = 1; count <= std::min(views, kMostShards); ++count)
    if (seconds(count, threads) <= most_seconds) return count;
  return 0;
}

Expected<Plan> make_plan(const Scene& scene, const RunOptions& options) {
  Plan plan;
  std::vector<int> views;
  std::vector<std::vector<int>> neighbors(scene.views.size());
  double compared = 0.0;  // pixels · neighbors
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const View& at = scene.views[static_cast<std::size_t>(view)];
    auto& chosen = neighbors[static_cast<std::size_t>(view)] = select_views(scene, view, options.views);
    if (chosen.size() < kLeastNeighbors) continue;
    views.push_back(view);
    const auto pixels = static_cast<std::uint64_t>(at.width) * static_cast<std::uint64_t>(at.height);
    plan.pixels += pixels;
    compared += static_cast<double>(pixels) * static_cast<double>(chosen.size());
  }
  if (views.empty()) return std::unexpected(no_neighbors_error(scene, options.views));
  plan.views = static_cast<int>(views.size());
  plan.left_out = static_cast<int>(scene.views.size()) - plan.views;
  QUORUM_ASSIGN(plan.grid, make_voxel_grid(scene, options.fusion));
  add_memory(scene, options, plan);
  QUORUM_ASSIGN(const ViewSample sample, sample_views(scene, views, neighbors, options));
  plan.swept_share = sample.swept / sample.pixels;
  plan.samples = sample.swept > 0 ? sample.samples / sample.swept : 0.0;
  const auto pixels = static_cast<double>(plan.pixels);
  const double passes = options.sweep.second_window == 0 ? 1.0 : 2.0;
  const double pass =
      compared * plan.swept_share * (plan.samples * sample.seconds_per_window() + sample.seconds_per_refinement());
  plan.half_seconds = sample.half_share() * pass;
  plan.depth_seconds = passes * pass + plan.half_seconds + kSaveSeconds * pixels;
  plan.confirm_seconds = options.confirm ? kConfirmSeconds * pixels : 0.0;
  plan.collect_seconds = kCollectSeconds * pixels;
  plan.merge_seconds = kMergeSeconds * pixels;
  plan.join_seconds = kMeshSeconds * static_cast<double>(plan.triangles);
  return plan;
}

}  // namespace quorum
