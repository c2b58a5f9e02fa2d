// Vulkan-Hpp with the defines of this project, and its exceptions as errors. No other file includes Vulkan, and no
// public header includes this one, since it takes seconds to compile.
#pragma once

#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS  // structs are filled with designated initializers
#define VULKAN_HPP_NO_STRUCT_SETTERS
#define VULKAN_HPP_NO_SPACESHIP_OPERATOR
#include <string>
#include <string_view>
#include <type_traits>
#include <vulkan/vulkan_raii.hpp>

#include "engine/core/error.h"

namespace quorum {

/// A failed Vulkan call as an Error: kMemory if host or device memory ran out, else kDevice.
/// doing: the clause in front, such as "creating kernel sweep_depth".
inline Error vulkan_error(std::string_view doing, const vk::SystemError& exception) {
  switch (static_cast<vk::Result>(exception.code().value())) {
    case vk::Result::eErrorOutOfDeviceMemory:
    case vk::Result::eErrorOutOfHostMemory:
    case vk::Result::eErrorTooManyObjects:
      return Error{
          ErrorKind::kMemory,
          "out of memory: give a larger --voxel-size, use --device cpu, or close other programs that use the device"}
          .within(doing);
    case vk::Result::eErrorDeviceLost:
      return Error{ErrorKind::kDevice,
                   "the device was lost, its driver has reset it: run again; if that repeats, update the driver or use "
                   "--device cpu"}
          .within(doing);
    default:
      return Error{ErrorKind::kDevice, std::string("Vulkan failed (") + exception.what() +
                                           "): update the driver, choose another --device, or use --device cpu"}
          .within(doing);
  }
}

/// Result of function, with a Vulkan exception that it throws turned into an Error.
template <typename Function>
auto guarded(std::string_view doing, const Function& function) -> Expected<std::invoke_result_t<Function>> {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Function>>) {
      function();
      return {};
    } else {
      return function();
    }
  } catch (const vk::SystemError& exception) {
    return std::unexpected(vulkan_error(doing, exception));
  }
}

}  // namespace quorum
