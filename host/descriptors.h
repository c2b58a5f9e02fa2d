// Descriptor sets that live for one submission. For the files of this layer alone.
#pragma once

#include <cstdint>
#include <vector>

#include "host/state.h"

namespace quorum {

/// Hands out descriptor sets from pools that grow in number as needed and are reset together.
class Descriptors {
 public:
  explicit Descriptors(const Device::State& device) : device_(&device) {}

  /// A set of the kernel's layout, to be written by the caller. Valid until reset. Throws vk::SystemError.
  vk::DescriptorSet make_set(const Kernel::State& kernel);
  /// Takes all sets back, once the device is done with them.
  void reset();

 private:
  static constexpr std::uint32_t kSetsPerPool = 64;
  static constexpr std::uint32_t kBuffersPerPool = 512;

  struct Pool {
    vk::raii::DescriptorPool handle = nullptr;
    std::uint32_t buffer_capacity = 0;
    std::uint32_t sets = 0;     ///< handed out
    std::uint32_t buffers = 0;  ///< in the sets handed out
  };
  Pool& pool_with_room(std::uint32_t buffers);

  const Device::State* device_;
  std::vector<Pool> pools_;
  std::size_t current_ = 0;  ///< pools before this one are full
};

}  // namespace quorum
