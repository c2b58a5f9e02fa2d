// The stages on the CPU, with oneTBB.
#pragma once

#include "engine/depth/sweep_depth.h"
#include "engine/pipeline/backend.h"

namespace quorum {

class CpuBackend : public Backend {
 public:
  explicit CpuBackend(const CpuSweepOptions& options = {}) : options_(options) {}

  [[nodiscard]] std::string description() const override;
  Expected<DepthMap> sweep_depth(const SweepTask& task) override;
  Expected<Grid<float>> confirm_depths(const ConfirmTask& task) override;
  Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) override;
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) override;
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) override;
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override;
  Expected<BlockPool> read_blocks() override;
  Expected<void> carve_blocks(const FusionView& view) override;
  Expected<std::vector<BlockBits>> read_empty() override;
  [[nodiscard]] std::size_t max_blocks(std::uint64_t host_bytes) const override;
  [[nodiscard]] std::uint64_t view_bytes(std::uint64_t pixels, int neighbors) const override;
  [[nodiscard]] std::vector<StageTime> kernel_times() const override { return times_; }
  [[nodiscard]] bool runs_on_host() const override { return true; }
  Expected<DeviceRates> measure_rates() override;  ///< one thread's share, since times are sums over the threads
  [[nodiscard]] SweepCounts sweep_counts() const override { return counts_; }

 private:
  /// Triangles and weights of a view's depth map.
  struct Surface {
    Grid<std::uint32_t> cells;
    Grid<std::uint32_t> weights;
  };
  Surface make_surface(const FusionView& view);
  /// Runs work and adds the CPU time that it took to those of the kernel.
  template <typename Work>
  auto timed(const char* kernel, const Work& work);
  void add_time(const char* kernel, double seconds);

  CpuSweepOptions options_;
  VoxelGrid grid_;
  FusionOptions fusion_;
  BlockPool pool_;
  std::vector<BlockBits> empty_;  // of all blocks of the grid
  std::vector<StageTime> times_;
  SweepCounts counts_;
};

}  // namespace quorum
