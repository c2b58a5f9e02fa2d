#include "tools/open_backend.h"

#include <fmt/format.h>

#ifdef QUORUM_HAS_VULKAN
#include "host/device_choice.h"
#include "host/vulkan_backend.h"
#endif

namespace quorum {

#ifdef QUORUM_HAS_VULKAN

Expected<std::unique_ptr<Backend>> open_backend(const std::string& request, const CpuSweepOptions& cpu) {
  auto choice = choose_device(request);
  if (!choice) return std::unexpected(choice.error());
  if (!choice->device) return std::make_unique<CpuBackend>(cpu);
  auto device = Device::open(*choice->device);
  if (!device) return std::unexpected(device.error());
  auto backend = VulkanBackend::create(*device);
  if (!backend) return std::unexpected(backend.error());
  return std::move(*backend);
}

#else

Expected<std::unique_ptr<Backend>> open_backend(const std::string& request, const CpuSweepOptions& cpu) {
  if (request == "auto" || request == "cpu") return std::make_unique<CpuBackend>(cpu);
  return failure(
      ErrorKind::kNoDevice,
      fmt::format("--device {}: this build has no Vulkan; give cpu, or build with QUORUM_VULKAN=ON", request));
}

#endif

}  // namespace quorum
