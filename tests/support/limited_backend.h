// A backend that takes few blocks at once, so that a small scene is fused in many slabs.
#pragma once

#include <algorithm>

#include "engine/pipeline/backend.h"

namespace quorum {

/// Passes everything on to another backend, but says that it has room for fewer blocks; counts what it is given.
class LimitedBackend : public Backend {
 public:
  LimitedBackend(Backend& inner, std::size_t most_blocks) : inner_(inner), most_blocks_(most_blocks) {}

  std::size_t largest_volume = 0;          ///< blocks that were allocated at once
  std::size_t integrated_block_views = 0;  ///< blocks that views were integrated into

  [[nodiscard]] std::string description() const override { return inner_.description(); }
  [[nodiscard]] std::size_t views_at_once() const override { return inner_.views_at_once(); }
  Expected<DepthMap> sweep_depth(const SweepTask& task) override { return inner_.sweep_depth(task); }
  Expected<Grid<float>> confirm_depths(const ConfirmTask& task) override { return inner_.confirm_depths(task); }
  Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) override {
    return inner_.begin_volume(grid, options);
  }
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) override {
    return inner_.collect_blocks(view);
  }
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) override {
    largest_volume = std::max(largest_volume, indices.size());
    return inner_.allocate_blocks(std::move(indices));
  }
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override {
    integrated_block_views += blocks.size();
    return inner_.integrate(view, blocks);
  }
  Expected<BlockPool> read_blocks() override { return inner_.read_blocks(); }
  Expected<void> carve_blocks(const FusionView& view) override { return inner_.carve_blocks(view); }
  Expected<std::vector<BlockBits>> read_empty() override { return inner_.read_empty(); }
  [[nodiscard]] std::size_t max_blocks(std::uint64_t host_bytes) const override {
    return std::min(most_blocks_, inner_.max_blocks(host_bytes));
  }
  [[nodiscard]] std::uint64_t view_bytes(std::uint64_t pixels, int neighbors) const override {
    return inner_.view_bytes(pixels, neighbors);
  }
  [[nodiscard]] std::vector<StageTime> kernel_times() const override { return inner_.kernel_times(); }
  [[nodiscard]] SweepCounts sweep_counts() const override { return inner_.sweep_counts(); }
  [[nodiscard]] DeviceWork device_work() const override { return inner_.device_work(); }

 private:
  Backend& inner_;
  std::size_t most_blocks_;
};

}  // namespace quorum
