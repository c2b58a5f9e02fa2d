#include "host/vulkan_backend.h"

#include <fmt/format.h>

#include <algorithm>

namespace quorum {

Expected<std::unique_ptr<VulkanBackend>> VulkanBackend::create(const Device& device, std::optional<SweepForm> form) {
  auto backend = std::unique_ptr<VulkanBackend>(new VulkanBackend(form));
  QUORUM_TRY(backend->open(device));
  return backend;
}

Expected<void> VulkanBackend::open(const Device& device) {
  QUORUM_ASSIGN(auto commands, Commands::create(device));
  stages_ = std::make_unique<Stages>(std::move(commands), form_);
  QUORUM_TRY(stages_->commands.submit());                                          // the failures of kernels,
  return stages_->views.with([](const ViewWorker&) { return Expected<void>(); });  // also of the first of these
}

Expected<void> VulkanBackend::renew() {
  lost_times_ = kernel_times();
  lost_work_ = device_work();
  const DeviceInfo info = device().info();
  QUORUM_ASSIGN(const Device opened, Device::open(info));
  return open(opened);
}

std::string VulkanBackend::description() const {
  const DeviceInfo& info = device().info();
  return fmt::format("{}, {} {}, Vulkan {}", info.name, info.driver_name, info.driver_version, info.api_version);
}

bool VulkanBackend::shares_memory() const {
  return device().info().kind == DeviceKind::kSoftware || device().info().kind == DeviceKind::kIntegrated;
}

std::size_t VulkanBackend::max_blocks(std::uint64_t host_bytes) const {
  constexpr std::uint64_t kBlockBytes = kBlockVoxels * sizeof(Voxel);
  const std::uint64_t device_bytes = device().info().largest_device_heap / 4 * 3;  // the rest for the views
  return std::min(shares_memory() ? host_bytes / 2 : host_bytes, device_bytes) / kBlockBytes;
}

std::uint64_t VulkanBackend::view_bytes(std::uint64_t pixels, int neighbors) const {
  constexpr std::uint64_t kStaging = 32 << 20;
  constexpr std::uint64_t kNccValues = 64 << 20;
  // Of the host: votes, ranges, what the planes begin with, support windows, the planes, the maps.
  const std::uint64_t host = kStaging + (neighbors > 0 ? 116 : 44) * pixels;
  if (!shares_memory()) return host;
  // Of the device: photographs (software Vulkan takes the four texels of a sample for each of their pixels; others have
  // them twice, each for itself and all in one buffer), support windows, ranges, votes, and planes twice.
  const std::uint64_t photograph = device().info().kind == DeviceKind::kSoftware ? 16 : 8;
  return host + kNccValues +
         (photograph * (1 + static_cast<std::uint64_t>(neighbors)) + (neighbors > 0 ? 100 : 24)) * pixels;
}

std::vector<StageTime> VulkanBackend::kernel_times() const {
  std::vector<StageTime> times = lost_times_;
  std::vector<RegionTiming> timings = stages_->commands.timings();
  const std::vector<RegionTiming> of_views = stages_->views.timings();
  timings.insert(timings.end(), of_views.begin(), of_views.end());
  for (const RegionTiming& timing : timings) {
    auto time = std::ranges::find(times, timing.name, &StageTime::name);
    if (time == times.end()) time = times.insert(time, StageTime{timing.name, 0.0});
    time->seconds += timing.seconds;
  }
  return times;
}

DeviceWork VulkanBackend::device_work() const {
  const DeviceWork work = device().work();
  return {lost_work_.uploaded_bytes + work.uploaded_bytes, lost_work_.downloaded_bytes + work.downloaded_bytes,
          lost_work_.submissions + work.submissions,       lost_work_.dispatches + work.dispatches,
          lost_work_.allocations + work.allocations,       lost_work_.waited_seconds + work.waited_seconds};
}

}  // namespace quorum
