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

constexpr std::uint64_t kWord = 4;                  // kernels and vkCmdFillBuffer work on whole words
constexpr std::uint64_t kStagingBytes = 16U << 20;  // a copy of this size takes far longer than its submission

std::string in_mib(std::uint64_t bytes) { return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1U << 20)); }

Allocation allocate_storage(const Device::State& device, std::uint64_t capacity) {
  const vk::BufferUsageFlags usage =
      Usage::eStorageBuffer | Usage::eUniformTexelBuffer | Usage::eTransferSrc | Usage::eTransferDst;
  // Mapped memory is used directly only where the host also reads it fast (cached): integrated GPUs and software.
  // Discrete GPUs have a window into their memory, but reading through it is slower than a copy.
  const vk::MemoryPropertyFlags direct =
      Flag::eDeviceLocal | Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached;
  if (device.options.force_staging) {
    Allocation made = device.allocate(capacity, usage, {Flag::eDeviceLocal});
    made.mapped = nullptr;
    return made;
  }
  return device.allocate(capacity, usage, {direct, Flag::eDeviceLocal});
}

Expected<void> make_staging(Device::State& device) {
  if (*device.staging.buffer) return {};
  return guarded("allocating the staging buffer", [&] {
    const vk::MemoryPropertyFlags mapped = Flag::eHostVisible | Flag::eHostCoherent;
    device.staging =
        device.allocate(kStagingBytes, Usage::eTransferSrc | Usage::eTransferDst, {mapped | Flag::eHostCached, mapped});
  });
}

}  // namespace

Buffer::Buffer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Buffer::Buffer(Buffer&& other) noexcept = default;
Buffer& Buffer::operator=(Buffer&& other) noexcept = default;
Buffer::~Buffer() = default;

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
    auto state = std::make_unique<State>();
    state->device = device.state();
    state->size = size_bytes;
    state->capacity = (std::max<std::uint64_t>(size_bytes, 1) + kWord - 1) / kWord * kWord;
    state->allocation = allocate_storage(*state->device, state->capacity);
    return Buffer(std::move(state));
  });
}

Expected<Buffer> Buffer::of_bytes(const Device& device, std::span<const std::byte> bytes, BufferUse use) {
  auto buffer = create(device, bytes.size(), use);
  if (!buffer) return buffer;
  if (auto done = buffer->upload_bytes(bytes, 0); !done) return std::unexpected(done.error());
  return buffer;
}

std::uint64_t Buffer::size() const { return state_->size; }

Expected<void> Buffer::upload_bytes(std::span<const std::byte> bytes, std::uint64_t offset) {
  QUORUM_CHECK_LE(offset, state_->size);
  QUORUM_CHECK_LE(bytes.size(), state_->size - offset);
  if (bytes.empty()) return {};
  if (state_->allocation.mapped != nullptr) {
    std::memcpy(state_->allocation.mapped + offset, bytes.data(), bytes.size());
    return {};
  }
  Device::State& device = *state_->device;
  const std::scoped_lock lock(device.transfer_mutex);
  if (auto made = make_staging(device); !made) return made;
  for (std::uint64_t done = 0; done < bytes.size(); done += kStagingBytes) {
    const std::uint64_t size = std::min(kStagingBytes, bytes.size() - done);
    std::memcpy(device.staging.mapped, bytes.data() + done, size);
    const auto copied = device.transfer_now("uploading a buffer", [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(*device.staging.buffer, *state_->allocation.buffer,
                          vk::BufferCopy{.dstOffset = offset + done, .size = size});
    });
    if (!copied) return copied;
  }
  return {};
}

Expected<void> Buffer::download_bytes(std::span<std::byte> bytes, std::uint64_t offset) const {
  QUORUM_CHECK_LE(offset, state_->size);
  QUORUM_CHECK_LE(bytes.size(), state_->size - offset);
  if (bytes.empty()) return {};
  if (state_->allocation.mapped != nullptr) {
    std::memcpy(bytes.data(), state_->allocation.mapped + offset, bytes.size());
    return {};
  }
  Device::State& device = *state_->device;
  const std::scoped_lock lock(device.transfer_mutex);
  if (auto made = make_staging(device); !made) return made;
  for (std::uint64_t done = 0; done < bytes.size(); done += kStagingBytes) {
    const std::uint64_t size = std::min(kStagingBytes, bytes.size() - done);
    const auto copied = device.transfer_now("downloading a buffer", [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(*state_->allocation.buffer, *device.staging.buffer,
                          vk::BufferCopy{.srcOffset = offset + done, .size = size});
    });
    if (!copied) return copied;
    std::memcpy(bytes.data() + done, device.staging.mapped, size);
  }
  return {};
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
