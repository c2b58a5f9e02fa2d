// Storage buffers on a device, and parts of them as kernels see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/core/error.h"
#include "host/device.h"

namespace quorum {

/// A vector, array, Grid::values or span of what can be copied byte by byte.
template <typename Range>
concept PlainValues = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range> &&
    std::is_trivially_copyable_v<std::ranges::range_value_t<Range>>;

/// How kernels see a buffer: all of it as words, or as texels or part by part, for which it may be larger.
enum class BufferUse { kWhole, kInParts };

/// A storage buffer in the memory of a device. Transfers are done when they return; they must not overlap a submission
/// that uses the buffer, and need none to have come before. Copies are the same buffer.
class Buffer {
 public:
  /// No buffer: of size 0, to be assigned to, or handed to Commands that have failed.
  Buffer() = default;

  /// A buffer of size_bytes, 0 included, with undefined content. Fails (kMemory) if no kernel can see a buffer of this
  /// size on the device in this way, or if its memory is used up; (kDevice) if the driver fails.
  static Expected<Buffer> create(const Device& device, std::uint64_t size_bytes, BufferUse use = BufferUse::kWhole);

  /// A buffer that holds values. Fails as create and upload do.
  template <PlainValues Range>
  static Expected<Buffer> of(const Device& device, const Range& values, BufferUse use = BufferUse::kWhole) {
    return of_bytes(device, std::as_bytes(std::span(values)), use);
  }

  /// Size in bytes, as asked for.
  [[nodiscard]] std::uint64_t size() const;

  /// Copies values into the buffer from offset_bytes on; they must fit. Fails (kDevice, kMemory) if the device does.
  template <PlainValues Range>
  Expected<void> upload(const Range& values, std::uint64_t offset_bytes = 0) {
    return upload_bytes(std::as_bytes(std::span(values)), offset_bytes);
  }

  /// Fills values from the buffer from offset_bytes on; there must be enough. Fails (kDevice, kMemory) if the device
  /// does.
  template <PlainValues Range>
  Expected<void> download(Range&& values, std::uint64_t offset_bytes = 0) const {
    return download_bytes(std::as_writable_bytes(std::span(values)), offset_bytes);
  }

  /// Fills the buffer with zero bytes. Fails (kDevice, kMemory) if the device does.
  Expected<void> fill_zero();

  /// What the buffer holds of Vulkan (host/state.h); for the files of this layer.
  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  explicit Buffer(std::shared_ptr<State> state) : state_(std::move(state)) {}
  static Expected<Buffer> of_bytes(const Device& device, std::span<const std::byte> bytes, BufferUse use);
  Expected<void> upload_bytes(std::span<const std::byte> bytes, std::uint64_t offset);
  Expected<void> download_bytes(std::span<std::byte> bytes, std::uint64_t offset) const;

  std::shared_ptr<State> state_;
};

/// A buffer or a part of it, as a kernel sees it. Does not own the buffer.
struct BufferView {
  const Buffer* buffer;
  std::uint64_t offset = 0;  ///< bytes; a multiple of DeviceInfo::storage_buffer_alignment
  std::uint64_t size = 0;    ///< bytes

  BufferView(const Buffer& whole) : buffer(&whole), size(whole.size()) {}
  BufferView(const Buffer& whole, std::uint64_t view_offset, std::uint64_t view_size)
      : buffer(&whole), offset(view_offset), size(view_size) {}
};

}  // namespace quorum
