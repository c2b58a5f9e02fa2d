// What a run can work on. Results are the same on every device.
#pragma once

#include <quorum/result.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace quorum::v0 {

struct Device {
  std::string option;              ///< the value of the option "device" that chooses it: "cpu", or an index
  std::string name;                ///< of the device, or the CPU's in words
  std::string kind;                ///< "CPU", "discrete GPU", "integrated GPU", "virtual GPU", "software Vulkan" …
  std::string driver;              ///< and its version; empty if it does not tell
  std::uint64_t memory_bytes = 0;  ///< of the device; 0: that of the host
  std::string defect;              ///< why it can't be used; empty if it can
};

/// The CPU, then the Vulkan devices in Vulkan's order, usable or not. Without a Vulkan loader or driver, or in a
/// library that was built without Vulkan, the CPU alone.
[[nodiscard]] QUORUM_API Result<std::vector<Device>> list_devices();

/// The device that a run with this option "device" would use. request: "auto" (the usable GPU with the most memory,
/// else the CPU), "cpu", an index, or a part of a name. Fails (kNoDevice) if there is none; the message lists what
/// there is.
[[nodiscard]] QUORUM_API Result<Device> choose_device(std::string_view request = "auto");

}  // namespace quorum::v0
