#include "host/window_kernels.h"

#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

const Kernel& WindowKernels::at(int window) {
  Kernel& kernel = kernels_[window];
  if (kernel.empty()) {
    const auto shift = static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window));
    kernel = commands_->kernel(name_, {{"kWindow", static_cast<std::uint32_t>(window)}, {"kShift", shift}});
  }
  return kernel;
}

}  // namespace quorum
