#include "host/device_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace quorum {
namespace {

using Candidates = std::vector<const DeviceInfo*>;

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string list_text(std::span<const DeviceInfo> devices) {
  if (devices.empty()) return "there is no Vulkan device; use cpu";
  std::string text = "there are ";
  for (const DeviceInfo& device : devices) {
    text += fmt::format("{}: {} ({}{}), ", device.index, device.name, to_string(device.kind),
                        device.usable() ? "" : ", not usable");
  }
  return text + "and cpu";
}

std::unexpected<Error> no_device(std::string_view request, std::string_view what, std::span<const DeviceInfo> devices) {
  return failure(ErrorKind::kNoDevice, fmt::format("--device {}: {}; {}", request, what, list_text(devices)));
}

DeviceChoice choose_automatically(std::span<const DeviceInfo> devices) {
  for (const DeviceKind kind : {DeviceKind::kDiscrete, DeviceKind::kIntegrated, DeviceKind::kVirtual}) {
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& device : devices) {
      if (device.kind != kind || !device.usable()) continue;
      if (best == nullptr || device.largest_device_heap > best->largest_device_heap) best = &device;
    }
    if (best != nullptr) return {*best, fmt::format("the usable {} with the largest memory", to_string(kind))};
  }
  for (const DeviceInfo& device : devices) {
    if (device.kind != DeviceKind::kSoftware && !device.usable()) {
      return {{}, fmt::format("no GPU can be used; {}: {}", device.name, device.defect)};
    }
  }
  if (std::ranges::any_of(devices, [](const auto& device) { return device.kind == DeviceKind::kSoftware; })) {
    return {{}, "there is no GPU, and the CPU path is about twice as fast as software Vulkan"};
  }
  return {{}, "there is no Vulkan GPU"};
}

Candidates with_index(std::string_view request, std::span<const DeviceInfo> devices) {
  int index = 0;
  const auto [end, error] = std::from_chars(request.data(), request.data() + request.size(), index);
  if (error != std::errc() || end != request.data() + request.size()) return {};
  Candidates found;
  for (const DeviceInfo& device : devices) {
    if (device.index == index) found.push_back(&device);
  }
  return found;
}

Candidates with_name(std::string_view request, std::span<const DeviceInfo> devices) {
  Candidates found;
  for (const DeviceInfo& device : devices) {
    if (lowered(device.name) == lowered(request)) found.push_back(&device);
  }
  if (!found.empty() || request.empty()) return found;
  for (const DeviceInfo& device : devices) {
    if (lowered(device.name).find(lowered(request)) != std::string::npos) found.push_back(&device);
  }
  return found;
}

}  // namespace

Expected<DeviceChoice> choose_device(std::string_view request, std::span<const DeviceInfo> devices) {
  if (request == "auto") return choose_automatically(devices);
  if (request == "cpu") return DeviceChoice{{}, "chosen by the user"};

  // A number that is no index may still be part of a name: "4090".
  Candidates found = with_index(request, devices);
  if (found.empty()) found = with_name(request, devices);
  if (found.empty()) return no_device(request, "no device has this index or name", devices);

  const DeviceInfo* first = found.front();
  std::erase_if(found, [](const DeviceInfo* device) { return !device->usable(); });
  if (found.empty())
    return no_device(request, fmt::format("{} can't be used: {}", first->name, first->defect), devices);
  first = found.front();
  if (std::ranges::any_of(found, [&](const DeviceInfo* device) { return device->name != first->name; }))
    return no_device(request, "this fits devices with different names, say more or give an index", devices);
  if (found.size() == 1) return DeviceChoice{*first, "chosen by the user"};
  return DeviceChoice{*first, fmt::format("chosen by the user, the first of {} with this name", found.size())};
}

Expected<DeviceChoice> choose_device(std::string_view request) {
  if (request == "cpu") return choose_device(request, {});
  const auto devices = list_devices();
  if (devices) return choose_device(request, *devices);
  if (request == "auto") return DeviceChoice{{}, devices.error().message};
  return std::unexpected(devices.error());
}

}  // namespace quorum
