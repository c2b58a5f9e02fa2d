#include "host/vulkan_backend.h"

#include <fmt/format.h>

#include <algorithm>

namespace quorum {

Expected<std::unique_ptr<VulkanBackend>> VulkanBackend::create(const Device& device, std::optional<SweepForm> form) {
  auto kept_device = std::make_unique<Device>(device);  // the stages point to it, so it must not move
  auto commands = Commands::create(*kept_device);
  if (!commands) return std::unexpected(commands.error());
  auto kept_commands = std::make_unique<Commands>(std::move(*commands));
  auto depth = DepthStage::create(*kept_device, *kept_commands, form);
  if (!depth) return std::unexpected(depth.error());
  auto confirm = ConfirmStage::create(*kept_device, *kept_commands);
  if (!confirm) return std::unexpected(confirm.error());
  auto volume = VolumeStage::create(*kept_device, *kept_commands);
  if (!volume) return std::unexpected(volume.error());
  return std::unique_ptr<VulkanBackend>(new VulkanBackend(std::move(kept_device), std::move(kept_commands),
                                                          std::move(*depth), std::move(*confirm), std::move(*volume)));
}

std::string VulkanBackend::description() const {
  const DeviceInfo& info = device_->info();
  return fmt::format("{}, {} {}, Vulkan {}", info.name, info.driver_name, info.driver_version, info.api_version);
}

bool VulkanBackend::shares_memory() const {
  return device_->info().kind == DeviceKind::kSoftware || device_->info().kind == DeviceKind::kIntegrated;
}

std::size_t VulkanBackend::max_blocks(std::uint64_t host_bytes) const {
  constexpr std::uint64_t kBlockBytes = kBlockVoxels * sizeof(Voxel);
  const std::uint64_t device_bytes = device_->info().largest_device_heap / 4 * 3;  // the rest for the views
  return std::min(shares_memory() ? host_bytes / 2 : host_bytes, device_bytes) / kBlockBytes;
}

std::uint64_t VulkanBackend::view_bytes(std::uint64_t pixels, int neighbors) const {
  constexpr std::uint64_t kStaging = 16 << 20;
  constexpr std::uint64_t kNccValues = 64 << 20;
  // Of the host: votes, ranges, what the planes begin with, support windows, the planes, the maps.
  const std::uint64_t host = kStaging + (neighbors > 0 ? 116 : 44) * pixels;
  if (!shares_memory()) return host;
  // Of the device: photographs (software Vulkan takes the four texels of a sample for each of their pixels), support
  // windows, ranges, planes twice, and those that are tried.
  const std::uint64_t photograph = device_->info().kind == DeviceKind::kSoftware ? 16 : 4;
  return host + kNccValues +
         (photograph * (1 + static_cast<std::uint64_t>(neighbors)) + (neighbors > 0 ? 100 : 20)) * pixels;
}

std::vector<StageTime> VulkanBackend::kernel_times() const {
  std::vector<StageTime> times;
  for (const RegionTiming& timing : commands_->timings()) times.push_back({timing.name, timing.seconds});
  return times;
}

}  // namespace quorum
