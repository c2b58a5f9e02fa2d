// The stages on a Vulkan device.
#pragma once

#include <memory>

#include "engine/pipeline/backend.h"
#include "host/confirm_stage.h"
#include "host/depth_stage.h"
#include "host/device_rates.h"
#include "host/volume_stage.h"

namespace quorum {

class VulkanBackend : public Backend {
 public:
  /// form: of the sweep; empty = the one for this kind of device. Fails (kDevice, kMemory) if the device does. The
  /// backend keeps the device open.
  static Expected<std::unique_ptr<VulkanBackend>> create(const Device& device, std::optional<SweepForm> form = {});

  [[nodiscard]] std::string description() const override;
  Expected<DepthMap> sweep_depth(const SweepTask& task) override { return depth_.run(task); }
  Expected<Grid<float>> confirm_depths(const ConfirmTask& task) override { return confirm_.run(task); }
  Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) override {
    return volume_.begin(grid, options);
  }
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) override {
    return volume_.collect_blocks(view);
  }
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) override {
    return volume_.allocate_blocks(std::move(indices));
  }
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override {
    return volume_.integrate(view, blocks);
  }
  Expected<BlockPool> read_blocks() override { return volume_.read_blocks(); }
  Expected<void> carve_blocks(const FusionView& view) override { return volume_.carve_blocks(view); }
  Expected<std::vector<BlockBits>> read_empty() override { return volume_.read_empty(); }
  [[nodiscard]] std::size_t max_blocks(std::uint64_t host_bytes) const override;
  [[nodiscard]] std::uint64_t view_bytes(std::uint64_t pixels, int neighbors) const override;
  [[nodiscard]] std::vector<StageTime> kernel_times() const override;
  Expected<DeviceRates> measure_rates() override { return measure_device_rates(*device_); }

 private:
  /// True if the device's memory is the host's.
  [[nodiscard]] bool shares_memory() const;

  VulkanBackend(std::unique_ptr<Device> device, std::unique_ptr<Commands> commands, DepthStage depth,
                ConfirmStage confirm, VolumeStage volume)
      : device_(std::move(device)),
        commands_(std::move(commands)),
        depth_(std::move(depth)),
        confirm_(std::move(confirm)),
        volume_(std::move(volume)) {}

  std::unique_ptr<Device> device_;
  std::unique_ptr<Commands> commands_;
  DepthStage depth_;
  ConfirmStage confirm_;
  VolumeStage volume_;
};

}  // namespace quorum
