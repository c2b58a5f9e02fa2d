// The Vulkan loader and an instance of it; what an instance says of its devices. For the files of this folder alone.
#pragma once

#include <cstdint>
#include <optional>

#include "host/device_list.h"
#include "host/vulkan.h"

namespace quorum {

/// A loaded Vulkan with its instance.
struct Instance {
  vk::raii::Context context;
  vk::raii::Instance handle = nullptr;
  bool debug_utils = false;  ///< VK_EXT_debug_utils is on: labels and messages
};

/// Loads Vulkan 1.1. validation: with the Khronos validation layer, synchronization checks included.
/// Fails (kNoDevice) without a loader, without any driver, or if the wanted layer is not installed.
Expected<Instance> make_instance(bool validation);

/// A family of queues that can compute: with timestamps before without, and without graphics before with, so that long
/// work does not block a desktop. Empty if there is none.
std::optional<std::uint32_t> compute_queue_family(const vk::raii::PhysicalDevice& physical);

/// Properties of a device, and whether this program can use it.
DeviceInfo describe_device(const vk::raii::PhysicalDevice& physical, int index);

}  // namespace quorum
