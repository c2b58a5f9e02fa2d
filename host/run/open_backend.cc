#include "host/run/open_backend.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "engine/core/option.h"
#include "engine/pipeline/cpu_backend.h"

#ifdef QUORUM_HAS_VULKAN
#include "host/device_choice.h"
#include "host/vulkan_backend.h"
#endif

namespace quorum {
namespace {

std::unique_ptr<Backend> make_cpu_backend(const RunOptions& options) {
  return std::make_unique<CpuBackend>(
      CpuSweepOptions{options.simd.value_or(best_simd_level()), options.tile_width, options.tile_height});
}

}  // namespace

#ifdef QUORUM_HAS_VULKAN

Expected<std::unique_ptr<Backend>> open_backend(const RunOptions& options) {
  QUORUM_ASSIGN(auto choice, choose_device(options.device));
  if (!choice.device) return make_cpu_backend(options);
  const bool as_gpu = choice.device->kind == DeviceKind::kSoftware && std::getenv("QUORUM_SOFTWARE_AS_GPU") != nullptr;
  QUORUM_ASSIGN(auto device, Device::open(*choice.device, {.force_staging = as_gpu}));
  const std::optional<SweepForm> form = as_gpu ? std::optional(SweepForm::kGroups) : std::nullopt;
  QUORUM_ASSIGN(auto backend, VulkanBackend::create(device, form));
  return backend;
}

#else

Expected<std::unique_ptr<Backend>> open_backend(const RunOptions& options) {
  if (options.device == "auto" || options.device == "cpu") return make_cpu_backend(options);
  return failure(ErrorKind::kNoDevice,
                 fmt::format("{} {}: this build has no Vulkan; give cpu, or build with QUORUM_VULKAN=ON",
                             option_name("device"), options.device));
}

#endif

}  // namespace quorum
