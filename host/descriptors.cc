#include "host/descriptors.h"

#include <algorithm>
#include <array>

namespace quorum {

vk::DescriptorSet Descriptors::make_set(const Kernel::State& kernel) {
  Pool& pool = pool_with_room(kernel.layout.buffer_count);
  vk::raii::DescriptorSets sets(
      device_->device, {.descriptorPool = *pool.handle, .descriptorSetCount = 1, .pSetLayouts = &*kernel.set_layout});
  ++pool.sets;
  pool.buffers += kernel.layout.buffer_count;
  return sets.front().release();
}

void Descriptors::reset() {
  for (Pool& pool : pools_) {
    pool.handle.reset();
    pool.sets = 0;
    pool.buffers = 0;
  }
  current_ = 0;
}

Descriptors::Pool& Descriptors::pool_with_room(std::uint32_t buffers) {
  for (; current_ < pools_.size(); ++current_) {
    Pool& pool = pools_[current_];
    if (pool.sets < kSetsPerPool && pool.buffers + buffers <= pool.buffer_capacity) return pool;
  }
  const std::uint32_t capacity = std::max(kBuffersPerPool, buffers);
  const std::array sizes = {
      vk::DescriptorPoolSize{.type = descriptor_type(BufferKind::kStorage), .descriptorCount = capacity},
      vk::DescriptorPoolSize{.type = descriptor_type(BufferKind::kTexels), .descriptorCount = capacity}};
  Pool made{.buffer_capacity = capacity};
  made.handle = {
      device_->device,
      vk::DescriptorPoolCreateInfo{.maxSets = kSetsPerPool, .poolSizeCount = sizes.size(), .pPoolSizes = sizes.data()}};
  pools_.push_back(std::move(made));
  return pools_.back();
}

}  // namespace quorum
