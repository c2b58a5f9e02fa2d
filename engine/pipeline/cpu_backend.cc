#include "engine/pipeline/cpu_backend.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <new>
#include <utility>

#include "engine/core/clock.h"
#include "engine/core/host_rates.h"
#include "engine/core/option.h"
#include "engine/volume/collect_blocks.h"
#include "engine/volume/integrate.h"
#include "engine/volume/range_surface.h"
#include "engine/volume/weigh_surface.h"

namespace quorum {

template <typename Work>
auto CpuBackend::timed(const char* kernel, const Work& work) {
  const double start = foreground_cpu_seconds();
  auto result = work();
  add_time(kernel, foreground_cpu_seconds() - start);
  return result;
}

void CpuBackend::add_time(const char* kernel, double seconds) {
  auto time = std::ranges::find(times_, kernel, &StageTime::name);
  if (time == times_.end()) time = times_.insert(time, StageTime{kernel, 0.0});
  time->seconds += seconds;
}

CpuBackend::Surface CpuBackend::make_surface(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  Surface surface;
  surface.cells = timed("range_surface", [&] {
    return range_surface(view.map.depth, make_range_surface_params(view.camera, width, height, fusion_),
                         view.normals != nullptr ? *view.normals : Grid<std::uint32_t>());
  });
  surface.weights = timed("weigh_surface", [&] {
    return weigh_surface(view.map.depth, view.map.confidence, surface.cells,
                         make_weigh_surface_params(view.camera, width, height, fusion_));
  });
  return surface;
}

std::string CpuBackend::description() const {
  const char* simd = options_.simd == SimdLevel::kAvx512 ? "AVX-512"
                     : options_.simd == SimdLevel::kAvx2 ? "AVX2"
                                                         : "baseline";
  return fmt::format("CPU, {} threads, {}",
                     tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism), simd);
}

Expected<DepthMap> CpuBackend::sweep_depth(const SweepTask& task) {
  SweepWork work;
  DepthMap map = quorum::sweep_depth(task, options_, &work);
  add_time("sweep_depth", work.sweep.cpu_seconds);
  const bool slanted = task.options.is_slanted();
  add_time(slanted ? "refine_planes" : "refine_depth", work.refine.cpu_seconds);
  counts_.sweep_windows += work.sweep.windows;
  counts_.sweep_samples += work.sweep.samples;
  counts_.refine_windows += work.refine.windows;
  counts_.refine_samples += work.refine.samples;
  return map;
}

Expected<Grid<float>> CpuBackend::confirm_depths(const ConfirmTask& task) {
  return timed("confirm_depths", [&] { return quorum::confirm_depths(task, options_.simd); });
}

Expected<void> CpuBackend::begin_volume(const VoxelGrid& grid, const FusionOptions& options) {
  grid_ = grid;
  fusion_ = options;
  pool_ = {};
  empty_ = {};
  if (!options.fill_holes) return {};
  try {
    empty_.assign(grid.block_count(), BlockBits{});
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::kMemory,
                   fmt::format("carving needs {} MiB; give a larger {}", grid.block_count() * sizeof(BlockBits) >> 20,
                               option_name("voxel-size")));
  }
  return {};
}

Expected<std::vector<std::uint32_t>> CpuBackend::collect_blocks(const FusionView& view) {
  const Surface surface = make_surface(view);
  return timed("collect_blocks", [&] {
    return block_indices(
        quorum::collect_blocks(view.map.depth, surface.weights,
                               make_collect_params(view.camera, view.map.depth.width, view.map.depth.height, grid_)));
  });
}

Expected<void> CpuBackend::allocate_blocks(std::vector<std::uint32_t> indices) {
  pool_.indices = std::move(indices);
  try {
    pool_.voxels.assign(pool_.indices.size() * kBlockVoxels, Voxel{});
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::kMemory, fmt::format("the volume needs {} MiB for {} blocks; give a larger {}",
                                                   pool_.indices.size() * kBlockVoxels * sizeof(Voxel) >> 20,
                                                   pool_.indices.size(), option_name("voxel-size")));
  }
  return {};
}

Expected<void> CpuBackend::integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) {
  const Surface surface = make_surface(view);
  return timed("integrate", [&]() -> Expected<void> {
    quorum::integrate({view.map.depth, surface.cells, surface.weights, view.image}, find_slots(blocks, pool_.indices),
                      make_integrate_params(view.camera, view.map.depth.width, view.map.depth.height, grid_),
                      options_.simd, pool_.voxels);
    return {};
  });
}

Expected<BlockPool> CpuBackend::read_blocks() { return std::exchange(pool_, {}); }

Expected<void> CpuBackend::carve_blocks(const FusionView& view) {
  const Surface surface = make_surface(view);
  return timed("carve_blocks", [&]() -> Expected<void> {
    quorum::carve_blocks(
        {view.map.depth, surface.cells, surface.weights}, blocks_in_sight(view.map.depth, view.camera, grid_),
        make_integrate_params(view.camera, view.map.depth.width, view.map.depth.height, grid_), options_.simd, empty_);
    return {};
  });
}

Expected<std::vector<BlockBits>> CpuBackend::read_empty() { return std::exchange(empty_, {}); }

std::size_t CpuBackend::max_blocks(std::uint64_t host_bytes) const {
  return host_bytes / (kBlockVoxels * sizeof(Voxel));
}

std::uint64_t CpuBackend::view_bytes(std::uint64_t pixels, int neighbors) const {
  // The sweep: votes, planes twice, what they begin with, their ranges, support windows, the maps. The surface:
  // cells, weights, maps.
  if (neighbors == 0) return 44 * pixels;
  return (136 + sizeof(std::uint64_t) * static_cast<std::uint64_t>(neighbors)) * pixels;  // and texel columns
}

Expected<DeviceRates> CpuBackend::measure_rates() {
  const HostRates all = measure_host_rates();
  return DeviceRates{all.operations_per_second / all.threads, all.bytes_per_second / all.threads};
}

}  // namespace quorum
