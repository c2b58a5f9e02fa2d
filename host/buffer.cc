#include "host/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/core/check.h"
#include "host/state.h"

namespace quorum {
namespace {

using Flag = vk::MemoryPropertyFlagBits;
using Usage = vk::BufferUsageFlagBits;

constexpr std::uint64_t kWord = 4;  // kernels and vkCmdFillBuffer work on whole words

std::string in_mib(std::uint64_t bytes) { return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1U << 20)); }

/// Memory for a buffer: mapped, or else what another one gave back, or new.
Allocation allocate_storage(Device::State& device, std::uint64_t capacity) {
  const vk::BufferUsageFlags usage =
      Usage::eStorageBuffer | Usage::eUniformTexelBuffer | Usage::eTransferSrc | Usage::eTransferDst;
  if (device.maps_buffers) return device.allocate(capacity, usage, {kDirectMemory, Flag::eDeviceLocal});
  const std::uint64_t size = std::min(MemoryPool::size_class(capacity), std::max(capacity, device.info.max_allocation));
  if (auto pooled = device.pool.take(size)) return *std::move(pooled);
  const auto make = [&] {
    Allocation made = device.allocate(size, usage, {Flag::eDeviceLocal});
    made.mapped = nullptr;
    return made;
  };
  try {
    return make();
  } catch (const vk::OutOfDeviceMemoryError&) {
    if (!device.pool.clear()) throw;
  } catch (const vk::TooManyObjectsError&) {
    if (!device.pool.clear()) throw;
  }
  return make();
}

Expected<void> make_staging(Device::State& device) {
  if (*device.staging.buffer) return {};
  return guarded("allocating the staging buffer", [&] { device.staging = device.allocate_staging(); });
}

void copy(std::span<const std::byte> values, std::byte* mapped) { std::memcpy(mapped, values.data(), values.size()); }
void copy(std::span<std::byte> values, std::byte* mapped) { std::memcpy(values.data(), mapped, values.size()); }

// Values that are const go to the buffer, from offset on, others come from there: at once where it is mapped, else
// piece by piece through the staging buffer.
template <typename Byte>
Expected<void> transfer(const Buffer::State& buffer, std::span<Byte> values, std::uint64_t offset) {
  constexpr bool kUpload = std::is_const_v<Byte>;
  QUORUM_CHECK_LE(offset, buffer.size);
  QUORUM_CHECK_LE(values.size(), buffer.size - offset);
  if (values.empty()) return {};
  auto& counter = kUpload ? buffer.device->work.uploaded_bytes : buffer.device->work.downloaded_bytes;
  counter += values.size();
  if (buffer.allocation.mapped != nullptr) {
    copy(values, buffer.allocation.mapped + offset);
    return {};
  }
  Device::State& device = *buffer.device;
  const std::scoped_lock lock(device.transfer_mutex);
  QUORUM_TRY(make_staging(device));
  const vk::Buffer storage = *buffer.allocation.buffer;
  const vk::Buffer staging = *device.staging.buffer;
  for (std::uint64_t begin = 0; begin < values.size(); begin += kStagingBytes) {
    const auto piece = values.subspan(begin, std::min(kStagingBytes, values.size() - begin));
    const vk::BufferCopy up{.dstOffset = offset + begin, .size = piece.size()};
    const vk::BufferCopy down{.srcOffset = offset + begin, .size = piece.size()};
    if (kUpload) copy(piece, device.staging.mapped);
    QUORUM_TRY(device.transfer_now(kUpload ? "uploading a buffer" : "downloading a buffer", [&](const auto& commands) {
      kUpload ? commands.copyBuffer(staging, storage, up) : commands.copyBuffer(storage, staging, down);
    }));
    if (!kUpload) copy(piece, device.staging.mapped);
  }
  return {};
}

}  // namespace

Expected<Buffer> Buffer::create(const Device& device, std::uint64_t size_bytes, BufferUse use) {
  const DeviceInfo& info = device.info();
  const std::uint64_t limit =
      use == BufferUse::kWhole ? std::min(info.max_storage_buffer_range, info.max_allocation) : info.max_allocation;
  if (size_bytes > limit) {
    return failure(ErrorKind::kMemory,
                   fmt::format("a buffer of {} ({} bytes) exceeds the {} ({} bytes) that a kernel can see on {}: lower "
                               "--memory, or choose another --device",
                               in_mib(size_bytes), size_bytes, in_mib(limit), limit, info.name));
  }
  return guarded(fmt::format("allocating a buffer of {} on {}", in_mib(size_bytes), info.name), [&] {
    auto state = std::make_shared<State>();
    state->device = device.state();
    state->size = size_bytes;
    state->capacity = (std::max<std::uint64_t>(size_bytes, 1) + kWord - 1) / kWord * kWord;
    state->allocation = allocate_storage(*state->device, state->capacity);
    return Buffer(std::move(state));
  });
}

Expected<Buffer> Buffer::of_bytes(const Device& device, std::span<const std::byte> bytes, BufferUse use) {
  QUORUM_ASSIGN(auto buffer, create(device, bytes.size(), use));
  QUORUM_TRY(buffer.upload_bytes(bytes, 0));
  return buffer;
}

std::uint64_t Buffer::size() const { return state_ == nullptr ? 0 : state_->size; }

Expected<void> Buffer::upload_bytes(std::span<const std::byte> bytes, std::uint64_t offset) {
  return transfer(*state_, bytes, offset);
}

Expected<void> Buffer::download_bytes(std::span<std::byte> bytes, std::uint64_t offset) const {
  return transfer(*state_, bytes, offset);
}

Expected<void> Buffer::fill_zero() {
  if (state_->allocation.mapped != nullptr) {
    std::memset(state_->allocation.mapped, 0, state_->capacity);
    return {};
  }
  Device::State& device = *state_->device;
  const std::scoped_lock lock(device.transfer_mutex);
  return device.transfer_now("clearing a buffer", [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(*state_->allocation.buffer, 0, state_->capacity, 0);
  });
}

}  // namespace quorum
