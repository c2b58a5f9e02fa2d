#include "host/device_list.h"

#include "host/instance.h"
#include "host/vulkan.h"

namespace quorum {

std::string_view to_string(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::kDiscrete:
      return "discrete GPU";
    case DeviceKind::kIntegrated:
      return "integrated GPU";
    case DeviceKind::kVirtual:
      return "virtual GPU";
    case DeviceKind::kSoftware:
      return "software Vulkan";
    case DeviceKind::kOther:
      break;
  }
  return "other device";
}

Expected<std::vector<DeviceInfo>> list_devices() {
  QUORUM_ASSIGN(const auto instance, make_instance(false));
  return guarded("listing devices", [&] {
    std::vector<DeviceInfo> devices;
    try {
      for (const auto& physical : instance.handle.enumeratePhysicalDevices()) {
        devices.push_back(describe_device(physical, static_cast<int>(devices.size())));
      }
    } catch (const vk::InitializationFailedError&) {
      devices.clear();  // some loaders say so where there are drivers without a device
    }
    return devices;
  });
}

}  // namespace quorum
