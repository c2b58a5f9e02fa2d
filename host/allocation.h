// A Vulkan buffer with its memory. For the files of this layer alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/vulkan.h"

namespace quorum {

/// Mapped if the host can see it.
struct Allocation {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Buffer buffer = nullptr;
  std::byte* mapped = nullptr;
  std::uint64_t bytes = 0;
};

}  // namespace quorum
