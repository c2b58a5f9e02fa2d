// The stages on a Vulkan device.
#pragma once

#include <memory>

#include "engine/pipeline/backend.h"
#include "host/device_rates.h"
#include "host/view_workers.h"
#include "host/volume_stage.h"

namespace quorum {

class VulkanBackend : public Backend {
 public:
  /// form: of the sweep; empty = the one for this kind of device. Fails (kDevice, kMemory) if the device does. The
  /// backend keeps the device open.
  static Expected<std::unique_ptr<VulkanBackend>> create(const Device& device, std::optional<SweepForm> form = {});

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::size_t views_at_once() const override { return stages_->views.count(); }
  Expected<DepthMap> sweep_depth(const SweepTask& task) override {
    return stages_->views.with([&](ViewWorker& worker) { return worker.depth.run(task); });
  }
  Expected<Grid<float>> confirm_depths(const ConfirmTask& task) override {
    return stages_->views.with([&](ViewWorker& worker) { return worker.confirm.run(task); });
  }
  Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) override {
    stages_->views.forget();
    return stages_->volume.begin(grid, options);
  }
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) override {
    return stages_->volume.collect_blocks(view);
  }
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) override {
    return stages_->volume.allocate_blocks(std::move(indices));
  }
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override {
    return stages_->volume.integrate(view, blocks);
  }
  Expected<BlockPool> read_blocks() override { return stages_->volume.read_blocks(); }
  Expected<void> carve_blocks(const FusionView& view) override { return stages_->volume.carve_blocks(view); }
  Expected<std::vector<BlockBits>> read_empty() override { return stages_->volume.read_empty(); }
  [[nodiscard]] std::size_t max_blocks(std::uint64_t host_bytes) const override;
  [[nodiscard]] std::uint64_t view_bytes(std::uint64_t pixels, int neighbors) const override;
  /// Opens the device once more, with default options.
  Expected<void> renew() override;
  [[nodiscard]] std::vector<StageTime> kernel_times() const override;
  [[nodiscard]] DeviceWork device_work() const override;
  Expected<DeviceRates> measure_rates() override { return measure_device_rates(device()); }

 private:
  /// True if the device's memory is the host's.
  [[nodiscard]] bool shares_memory() const;

  /// What is gone with the device.
  struct Stages {
    Stages(Commands made, std::optional<SweepForm> form)
        : commands(std::move(made)), volume(commands), views(commands.device(), form) {}

    Commands commands;
    VolumeStage volume;
    ViewWorkers views;
  };
  explicit VulkanBackend(std::optional<SweepForm> form) : form_(form) {}
  Expected<void> open(const Device& device);
  [[nodiscard]] const Device& device() const { return stages_->commands.device(); }

  std::optional<SweepForm> form_;
  std::unique_ptr<Stages> stages_;
  std::vector<StageTime> lost_times_;  // of devices before, as the work
  DeviceWork lost_work_;
};

}  // namespace quorum
