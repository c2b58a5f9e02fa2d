#include <quorum/device.h>

#include "engine/pipeline/cpu_backend.h"
#include "host/api/boundary.h"

#ifdef QUORUM_HAS_VULKAN
#include "host/device_choice.h"
#else
#include "host/run/open_backend.h"
#endif

namespace quorum::v0 {
namespace {

Device cpu() { return {"cpu", quorum::CpuBackend().description(), "CPU", "", 0, ""}; }

#ifdef QUORUM_HAS_VULKAN

Device outward(const quorum::DeviceInfo& device) {
  return {std::to_string(device.index),
          device.name,
          std::string(quorum::to_string(device.kind)),
          device.driver_name + " " + device.driver_version,
          device.largest_device_heap,
          device.defect};
}

quorum::Expected<Device> choose(std::string_view request) {
  QUORUM_ASSIGN(const auto choice, quorum::choose_device(request));
  return choice.device ? outward(*choice.device) : cpu();
}

std::vector<Device> all_devices() {
  std::vector<Device> devices = {cpu()};
  if (const auto found = quorum::list_devices())
    for (const quorum::DeviceInfo& device : *found) devices.push_back(outward(device));
  return devices;
}

#else

quorum::Expected<Device> choose(std::string_view request) {
  quorum::RunOptions options;
  options.device = request;
  QUORUM_TRY(quorum::open_backend(options));
  return cpu();
}

std::vector<Device> all_devices() { return {cpu()}; }

#endif

}  // namespace

Result<std::vector<Device>> list_devices() {
  return at_boundary<std::vector<Device>>([]() -> quorum::Expected<std::vector<Device>> { return all_devices(); });
}

Result<Device> choose_device(std::string_view request) {
  return at_boundary<Device>([&] { return choose(request); });
}

}  // namespace quorum::v0
