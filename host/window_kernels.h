// A kernel for each size of window that was asked for.
#pragma once

#include <map>
#include <string_view>

#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class WindowKernels {
 public:
  /// name: of a kernel with the constants kWindow and kShift.
  WindowKernels(Commands& commands, std::string_view name) : commands_(&commands), name_(name) {}

  /// The kernel for windows of this side, pixels; made if there is none. The commands keep a failure.
  const Kernel& at(int window);

 private:
  Commands* commands_;
  std::string_view name_;
  std::map<int, Kernel> kernels_;
};

}  // namespace quorum
