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
  Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) override;
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) override;
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) override;
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override;
  Expected<BlockPool> read_blocks() override;

 private:
  CpuSweepOptions options_;
  VoxelGrid grid_;
  FusionOptions fusion_;
  BlockPool pool_;
};

}  // namespace quorum
