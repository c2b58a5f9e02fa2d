// quorum devices: what a run could work on, and what it would choose.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/pipeline/cpu_backend.h"
#include "tools/command.h"
#include "tools/messages.h"

#ifdef QUORUM_HAS_VULKAN
#include "host/device_choice.h"
#endif

namespace quorum {
namespace {

#ifdef QUORUM_HAS_VULKAN

nlohmann::ordered_json device_json(const DeviceInfo& device) {
  return {{"index", device.index},
          {"name", device.name},
          {"kind", to_string(device.kind)},
          {"driver", device.driver_name},
          {"driver_version", device.driver_version},
          {"vulkan", device.api_version},
          {"max_storage_buffer_range", device.max_storage_buffer_range},
          {"max_allocation", device.max_allocation},
          {"device_memory", device.largest_device_heap},
          {"subgroup_size", device.subgroup_size},
          {"max_work_group_invocations", device.max_work_group_invocations},
          {"shared_memory", device.shared_memory_bytes},
          {"usable", device.usable()},
          {"defect", device.defect}};
}

void print_device(const DeviceInfo& device) {
  print("{}: {} ({})\n", device.index, device.name, to_string(device.kind));
  print("   driver {} {}, Vulkan {}\n", device.driver_name, device.driver_version, device.api_version);
  print("   memory {} MiB, largest allocation {} MiB, largest buffer in a kernel {} MiB\n",
        device.largest_device_heap >> 20, device.max_allocation >> 20, device.max_storage_buffer_range >> 20);
  print("   work group up to {} invocations, {} KiB shared memory, subgroups of {}\n",
        device.max_work_group_invocations, device.shared_memory_bytes >> 10, device.subgroup_size);
  if (!device.usable()) print("   not usable: {}\n", device.defect);
}

Expected<void> list(const std::string& request, bool json) {
  const auto devices = list_devices();
  QUORUM_ASSIGN(const auto choice, choose_device(request));
  const std::string chosen = choice.device ? choice.device->name : CpuBackend().description();
  if (json) {
    nlohmann::ordered_json all = {{"devices", nlohmann::ordered_json::array()}};
    for (const DeviceInfo& device : devices.value_or(std::vector<DeviceInfo>{}))
      all["devices"].push_back(device_json(device));
    all["cpu"] = CpuBackend().description();
    all["chosen"] = chosen;
    all["reason"] = choice.reason;
    print("{}\n", all.dump(2));
    return {};
  }
  if (!devices)
    print("no Vulkan devices: {}\n", devices.error().message);
  else if (devices->empty())
    print("no Vulkan devices: the Vulkan loader finds no driver\n");
  else
    for (const DeviceInfo& device : *devices) print_device(device);
  print("cpu: {}\n", CpuBackend().description());
  print("--device {} uses: {} ({})\n", request, chosen, choice.reason);
  return {};
}

#else

Expected<void> list(const std::string&, bool json) {
  const std::string cpu = CpuBackend().description();
  if (json)
    print("{}\n", nlohmann::ordered_json{{"devices", nlohmann::ordered_json::array()},
                                         {"cpu", cpu},
                                         {"chosen", cpu},
                                         {"reason", "built without Vulkan"}}
                      .dump(2));
  else
    print("cpu: {}\nthis build has no Vulkan\n", cpu);
  return {};
}

#endif

}  // namespace

int devices_command(int argc, char** argv) {
  CommandLine line("List the devices, with their limits, and say which one a run would use and why.", "devices");
  std::string request = "auto";
  bool json = false;
  line.add("--device", request, "What a run would be asked for").with_default();
  line.add_switch("--json", json, "Print JSON; sizes in bytes");
  return run_command(line, argc, argv, [&] { return list(request, json); });
}

}  // namespace quorum
