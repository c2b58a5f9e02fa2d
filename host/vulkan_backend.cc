#include "host/vulkan_backend.h"

#include <fmt/format.h>

namespace quorum {

Expected<std::unique_ptr<VulkanBackend>> VulkanBackend::create(const Device& device) {
  auto kept_device = std::make_unique<Device>(device);  // the stages point to it, so it must not move
  auto commands = Commands::create(*kept_device);
  if (!commands) return std::unexpected(commands.error());
  auto kept_commands = std::make_unique<Commands>(std::move(*commands));
  auto depth = DepthStage::create(*kept_device, *kept_commands);
  if (!depth) return std::unexpected(depth.error());
  auto volume = VolumeStage::create(*kept_device, *kept_commands);
  if (!volume) return std::unexpected(volume.error());
  return std::unique_ptr<VulkanBackend>(
      new VulkanBackend(std::move(kept_device), std::move(kept_commands), std::move(*depth), std::move(*volume)));
}

std::string VulkanBackend::description() const {
  const DeviceInfo& info = device_->info();
  return fmt::format("{}, {} {}, Vulkan {}", info.name, info.driver_name, info.driver_version, info.api_version);
}

std::vector<StageTime> VulkanBackend::kernel_times() const {
  std::vector<StageTime> times;
  for (const RegionTiming& timing : commands_->timings()) times.push_back({timing.name, timing.seconds});
  return times;
}

}  // namespace quorum
