// A compute kernel, ready to be dispatched on one device.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "host/device.h"
#include "host/kernel_layout.h"
#include "host/kernel_table.h"

namespace quorum {

/// Copies are the same kernel.
class Kernel {
 public:
  /// No kernel: to be assigned to, or handed to Commands that have failed.
  Kernel() = default;

  /// Builds a kernel with specialization constants by name, such as {{"kWindow", 5}}; those not named keep the defaults
  /// of the shader. A name that the kernel does not declare stops the program. Fails (kDevice) if the work group or the
  /// number of buffers exceeds the device's limits, or if the driver can't compile the kernel. One that
  /// was built on the device and is still there is given again.
  static Expected<Kernel> create(const Device& device, const KernelCode& code,
                                 const std::vector<SpecConstant>& constants = {});

  /// True if this is no kernel.
  [[nodiscard]] bool empty() const { return state_ == nullptr; }
  [[nodiscard]] const std::string& name() const;
  /// Bindings, push-constant size, work-group size and constants, as specialized.
  [[nodiscard]] const KernelLayout& layout() const;

  /// What the kernel holds of Vulkan (host/state.h); for the files of this layer.
  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  explicit Kernel(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace quorum
