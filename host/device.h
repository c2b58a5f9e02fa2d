// One opened Vulkan device. Buffers, kernels and commands keep it open as long as they live.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/pipeline/device_work.h"
#include "host/device_list.h"

namespace quorum {

struct DeviceOptions {
  bool validation = false;     ///< load the validation layer and collect what it says; slow, for tests
  bool force_staging = false;  ///< copy through a staging buffer even where memory can be mapped; for tests
  std::uint64_t max_storage_buffer_range = 0;  ///< lowers that of the device, unless it is 0; for tests
};

/// Different objects made from one device may be used by different threads at once; one object by one thread at a time.
class Device {
 public:
  /// Opens a device of list_devices() with one compute queue. Fails (kNoDevice) if the device is not usable or no
  /// longer there, or if validation is wanted and not installed; (kDevice) if its driver fails.
  static Expected<Device> open(const DeviceInfo& info, const DeviceOptions& options = {});

  [[nodiscard]] const DeviceInfo& info() const;

  /// True where the host reads and writes buffers in place, so that nothing is gained by keeping them on the device.
  [[nodiscard]] bool maps_buffers() const;

  /// What was asked of it since it was opened.
  [[nodiscard]] DeviceWork work() const;

  /// Warnings and errors of the validation layer since the last call, and forgets them. Empty without validation.
  [[nodiscard]] std::vector<std::string> take_validation_messages() const;

  /// What the device holds of Vulkan (host/state.h); for the files of this layer.
  struct State;
  [[nodiscard]] const std::shared_ptr<State>& state() const { return state_; }

 private:
  explicit Device(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace quorum
