#include "engine/pipeline/cpu_backend.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <new>
#include <utility>

#include "engine/volume/collect_blocks.h"
#include "engine/volume/integrate.h"
#include "engine/volume/range_surface.h"
#include "engine/volume/weigh_surface.h"

namespace quorum {
namespace {

/// Triangles and weights of a view's depth map.
struct Surface {
  Grid<std::uint32_t> cells;
  Grid<std::uint32_t> weights;
};

Surface make_surface(const FusionView& view, const FusionOptions& options) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  Surface surface;
  surface.cells = range_surface(view.map.depth, make_range_surface_params(view.camera, width, height, options));
  surface.weights = weigh_surface(view.map.depth, view.map.confidence, surface.cells,
                                  make_weigh_surface_params(view.camera, width, height, options));
  return surface;
}

}  // namespace

std::string CpuBackend::description() const {
  const char* simd = options_.simd == SimdLevel::kAvx512 ? "AVX-512"
                     : options_.simd == SimdLevel::kAvx2 ? "AVX2"
                                                         : "baseline";
  return fmt::format("CPU, {} threads, {}",
                     tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism), simd);
}

Expected<DepthMap> CpuBackend::sweep_depth(const SweepTask& task) { return quorum::sweep_depth(task, options_); }

Expected<void> CpuBackend::begin_volume(const VoxelGrid& grid, const FusionOptions& options) {
  grid_ = grid;
  fusion_ = options;
  pool_ = {};
  return {};
}

Expected<std::vector<std::uint32_t>> CpuBackend::collect_blocks(const FusionView& view) {
  const Surface surface = make_surface(view, fusion_);
  return block_indices(
      quorum::collect_blocks(view.map.depth, surface.weights,
                             make_collect_params(view.camera, view.map.depth.width, view.map.depth.height, grid_)));
}

Expected<void> CpuBackend::allocate_blocks(std::vector<std::uint32_t> indices) {
  pool_.indices = std::move(indices);
  try {
    pool_.voxels.assign(pool_.indices.size() * kBlockVoxels, Voxel{});
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::kMemory,
                   fmt::format("the volume needs {} MiB for {} blocks; give a larger --voxel-size",
                               pool_.indices.size() * kBlockVoxels * sizeof(Voxel) >> 20, pool_.indices.size()));
  }
  return {};
}

Expected<void> CpuBackend::integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) {
  const Surface surface = make_surface(view, fusion_);
  quorum::integrate({view.map.depth, surface.cells, surface.weights, view.image}, find_slots(blocks, pool_.indices),
                    make_integrate_params(view.camera, view.map.depth.width, view.map.depth.height, grid_),
                    pool_.voxels);
  return {};
}

Expected<BlockPool> CpuBackend::read_blocks() { return std::exchange(pool_, {}); }

}  // namespace quorum
