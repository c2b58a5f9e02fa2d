// What a kernel's SPIR-V says of itself, read by SPIRV-Cross, so that nothing is said twice.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/kernel_table.h"

namespace quorum {

/// The wanted value of a specialization constant: the bits of an int, uint or float, or 0 and 1.
struct SpecConstant {
  std::string_view name;
  std::uint32_t value = 0;
};

/// A specialization constant as the kernel declares it.
struct DeclaredConstant {
  std::string name;         ///< "local_size_x" and so on for a constant that is declared only as work-group size
  std::uint32_t id = 0;     ///< its constant_id
  std::uint32_t value = 0;  ///< the wanted value, or else the default
};

/// How a kernel sees a buffer: as words that it may read and write (`buffer`), or as texels of four words that it only
/// reads (`usamplerBuffer`), which software Vulkan does several times faster.
enum class BufferKind { kStorage, kTexels };

struct KernelLayout {
  std::uint32_t buffer_count = 0;                       ///< bindings 0 to buffer_count - 1 of set 0
  std::vector<BufferKind> buffers;                      ///< the kind of each binding
  std::uint32_t push_constant_size = 0;                 ///< bytes
  std::array<std::uint32_t, 3> group_size = {1, 1, 1};  ///< invocations per work group
  std::vector<DeclaredConstant> constants;              ///< sorted by id
};

/// Reads the layout of a kernel under the wanted constants. Stops the program if a constant has an unknown name, or if
/// the kernel binds anything but storage buffers at consecutive bindings of set 0.
KernelLayout reflect_kernel(const KernelCode& code, const std::vector<SpecConstant>& constants);

}  // namespace quorum
