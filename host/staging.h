// A mapped buffer through which values go to buffers that are not, or come from there. For the files of this layer
// alone.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/error.h"
#include "host/state.h"

namespace quorum {

class Staging {
 public:
  explicit Staging(Device::State& device) : device_(&device) {}

  /// Makes the buffer if there is none. Fails (kDevice, kMemory) if the device does.
  Expected<void> open();
  [[nodiscard]] vk::Buffer buffer() const { return *allocation_.buffer; }

  /// Bytes that may still be put there.
  [[nodiscard]] std::uint64_t room() const { return kStagingBytes - used_; }
  /// Copies bytes behind those before, at most room(); returns where they stand.
  std::uint64_t put(std::span<const std::byte> bytes);
  /// Forgets what was put, when the device has taken it.
  void clear() { used_ = 0; }

  /// Copies bytes from the front, where the device has put them.
  void get(std::span<std::byte> bytes) const;

 private:
  Device::State* device_;
  Allocation allocation_;
  std::uint64_t used_ = 0;
};

}  // namespace quorum
