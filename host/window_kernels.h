// A kernel for each size of window that was asked for.
#pragma once

#include <map>
#include <string_view>

#include "engine/core/error.h"
#include "host/kernel.h"

namespace quorum {

class WindowKernels {
 public:
  /// name: of a kernel with the constants kWindow and kShift.
  WindowKernels(const Device& device, std::string_view name) : device_(&device), name_(name) {}

  /// Makes the kernel for windows of this side, pixels, unless there is one. Fails (kDevice) if the device does.
  Expected<void> prepare(int window);
  /// One that was prepared.
  [[nodiscard]] const Kernel& at(int window) const { return kernels_.at(window); }

 private:
  const Device* device_;
  std::string_view name_;
  std::map<int, Kernel> kernels_;
};

}  // namespace quorum
