// The Vulkan devices of this machine, as far as a user or a stage asks about them.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace quorum {

enum class DeviceKind { kDiscrete, kIntegrated, kVirtual, kSoftware, kOther };

/// The kind in words: "discrete GPU", "integrated GPU", "virtual GPU", "software Vulkan", "other device".
std::string_view to_string(DeviceKind kind);

/// One Vulkan device. Sizes are in bytes.
struct DeviceInfo {
  int index = 0;  ///< place in Vulkan's list, from 0
  std::string name;
  DeviceKind kind = DeviceKind::kOther;
  std::string driver_name;                       ///< empty if the driver does not tell
  std::string driver_version;                    ///< in the driver's own words
  std::string api_version;                       ///< of Vulkan: "1.3.230"
  std::uint64_t max_storage_buffer_range = 0;    ///< largest buffer that a kernel can see
  std::uint64_t storage_buffer_alignment = 1;    ///< of the offset of a BufferView
  std::uint64_t max_texel_buffer_elements = 0;   ///< texels of four words of a buffer that a kernel can see
  std::uint64_t largest_device_heap = 0;         ///< memory of the device
  std::uint64_t max_allocation = 0;              ///< largest single allocation
  std::uint32_t subgroup_size = 0;               ///< invocations that run in lockstep
  std::uint32_t max_work_group_invocations = 0;  ///< invocations in a work group
  bool has_float64 = false;                      ///< kernels may compute in double
  std::uint32_t shared_memory_bytes = 0;         ///< shared memory of a work group
  /// Iterations of all loops of one invocation together, after which the driver leaves every loop without a word: 65535
  /// on llvmpipe (measured, Mesa 22.3), unbounded elsewhere. Loops that the compiler unrolls do not count.
  std::uint32_t max_loop_iterations = std::numeric_limits<std::uint32_t>::max();
  std::optional<bool> rounds_to_nearest_even;  ///< float32 can be told to; empty if unknown. Informational
  std::optional<bool> preserves_denormals;     ///< likewise
  std::string defect;                          ///< why this program can't use it; empty if it can

  [[nodiscard]] bool usable() const { return defect.empty(); }
};

/// All Vulkan devices in Vulkan's order, usable or not; empty if Vulkan works and finds none.
/// Fails (kNoDevice) if there is no Vulkan loader or no driver; the message says what to install.
Expected<std::vector<DeviceInfo>> list_devices();

}  // namespace quorum
