// The kernels of shaders/, compiled and embedded at build time (cmake/Kernels.cmake).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/check.h"

namespace quorum {

/// One compiled kernel: the name of its file without ".comp", and its SPIR-V.
struct KernelCode {
  std::string_view name;
  std::span<const std::uint32_t> words;
};

/// All kernels of shaders/, sorted by name.
std::span<const KernelCode> kernel_table();

/// The kernel of this name. An unknown name stops the program.
inline const KernelCode& find_kernel(std::string_view name, std::span<const KernelCode> table = kernel_table()) {
  for (const KernelCode& code : table) {
    if (code.name == name) return code;
  }
  fail_check(__FILE__, __LINE__, "kernel name is in the table", name, table.size());
}

}  // namespace quorum
