// Descriptor sets that live for one submission. For the files of this layer alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/state.h"

namespace quorum {

/// A part of a buffer, bytes.
struct BoundRange {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// The range of a view in whole words, since kernels read words; at least one.
BoundRange range_of(const BufferView& view);

/// Hands out descriptor sets from pools that grow in number as needed and are reset together.
class Descriptors {
 public:
  explicit Descriptors(const Device::State& device) : device_(&device) {}

  /// A set that binds one buffer per binding of the kernel, in order. Valid until reset. Throws vk::SystemError.
  vk::DescriptorSet bind(const Kernel::State& kernel, std::span<const BufferView> buffers);
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
  vk::DescriptorSet make_set(const Kernel::State& kernel);
  Pool& pool_with_room(std::uint32_t buffers);

  const Device::State* device_;
  std::vector<Pool> pools_;
  std::vector<vk::raii::BufferView> texel_views_;  ///< that the sets refer to
  std::size_t current_ = 0;                        ///< pools before this one are full
};

}  // namespace quorum
