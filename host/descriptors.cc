#include "host/descriptors.h"

#include <algorithm>
#include <array>

#include "engine/core/check.h"

namespace quorum {
namespace {

vk::DescriptorBufferInfo storage_of(const BufferView& view, const vk::PhysicalDeviceLimits& limits) {
  QUORUM_CHECK_EQ(view.offset % limits.minStorageBufferOffsetAlignment, 0U);
  const auto [offset, size] = range_of(view);
  QUORUM_CHECK_LE(size, limits.maxStorageBufferRange);
  return {.buffer = *view.buffer->state().allocation.buffer, .offset = offset, .range = size};
}

vk::raii::BufferView texels_of(const BufferView& view, const Device::State& device) {
  constexpr std::uint64_t kTexelBytes = 16;
  QUORUM_CHECK_EQ(view.offset % device.limits.minTexelBufferOffsetAlignment, 0U);
  QUORUM_CHECK_EQ(view.size % kTexelBytes, 0U);
  QUORUM_CHECK_LE(view.size / kTexelBytes, device.limits.maxTexelBufferElements);
  return {device.device, vk::BufferViewCreateInfo{.buffer = *view.buffer->state().allocation.buffer,
                                                  .format = vk::Format::eR32G32B32A32Uint,
                                                  .offset = view.offset,
                                                  .range = view.size}};
}

}  // namespace

BoundRange range_of(const BufferView& view) {
  const std::uint64_t capacity = view.buffer->state().capacity;
  QUORUM_CHECK_LE(view.offset, view.buffer->size());
  QUORUM_CHECK_LE(view.size, view.buffer->size() - view.offset);
  const BoundRange range{view.offset, (std::max<std::uint64_t>(view.size, 1) + 3) / 4 * 4};
  QUORUM_CHECK_LE(range.offset + range.size, capacity);
  return range;
}

vk::DescriptorSet Descriptors::bind(const Kernel::State& kernel, std::span<const BufferView> buffers) {
  const vk::DescriptorSet set = make_set(kernel);
  for (std::uint32_t i = 0; i < buffers.size(); ++i) {
    const BufferView& view = buffers[i];
    QUORUM_CHECK_EQ(view.buffer->state().device == kernel.device, true);
    const BufferKind kind = kernel.layout.buffers[i];
    vk::WriteDescriptorSet write{
        .dstSet = set, .dstBinding = i, .descriptorCount = 1, .descriptorType = descriptor_type(kind)};
    vk::DescriptorBufferInfo storage;
    if (kind == BufferKind::kTexels) {
      texel_views_.push_back(texels_of(view, *device_));
      write.pTexelBufferView = &*texel_views_.back();
    } else {
      storage = storage_of(view, device_->limits);
      write.pBufferInfo = &storage;
    }
    device_->device.updateDescriptorSets(write, {});
  }
  return set;
}

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
  texel_views_.clear();
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
