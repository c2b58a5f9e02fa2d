#include "host/window_kernels.h"

#include <utility>

#include "engine/image/padded_image.h"
#include "host/kernel_table.h"
#include "shaders/layout.h"

namespace quorum {

Expected<void> WindowKernels::prepare(int window) {
  if (kernels_.contains(window)) return {};
  auto kernel = Kernel::create(*device_, find_kernel(name_),
                               {{"kWindow", static_cast<std::uint32_t>(window)},
                                {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}});
  if (!kernel) return std::unexpected(kernel.error());
  kernels_.emplace(window, std::move(*kernel));
  return {};
}

}  // namespace quorum
