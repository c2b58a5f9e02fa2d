// Which device a run uses, from what the user asked for and what there is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "host/device_list.h"

namespace quorum {

/// What a run works on, and why.
struct DeviceChoice {
  std::optional<DeviceInfo> device;  ///< empty: the CPU path, without Vulkan
  std::string reason;                ///< one clause for the user
};

/// Chooses among devices. request:
///   auto         the usable discrete GPU with the largest memory, else integrated, else virtual, else the CPU path;
///                never software Vulkan, since the CPU path is about twice as fast
///   cpu          the CPU path
///   a number     the device with this index, software Vulkan included
///   other text   the device with this in its name, whatever the case; of several with one name the first usable
/// Fails (kNoDevice) if nothing fits, if what fits can't be used, or if the text fits devices with different names; the
/// message lists what there is.
Expected<DeviceChoice> choose_device(std::string_view request, std::span<const DeviceInfo> devices);

/// The same among the devices of this machine. auto and cpu succeed without Vulkan too; anything else then fails as
/// list_devices does.
Expected<DeviceChoice> choose_device(std::string_view request);

}  // namespace quorum
