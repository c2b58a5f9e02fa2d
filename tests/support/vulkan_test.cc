#include "tests/support/vulkan_test.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "host/device_choice.h"

namespace quorum {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

Expected<DeviceInfo> find_test_device() {
  const auto devices = list_devices();
  if (!devices) return std::unexpected(devices.error());
  const std::string_view request = environment("QUORUM_TEST_DEVICE");
  if (!request.empty()) {
    const auto choice = choose_device(request, *devices);
    if (!choice) return std::unexpected(choice.error());
    if (!choice->device) return failure(ErrorKind::kNoDevice, "QUORUM_TEST_DEVICE chose the CPU: " + choice->reason);
    return *choice->device;
  }
  const auto first = std::ranges::find_if(*devices, &DeviceInfo::usable);
  if (first == devices->end()) return failure(ErrorKind::kNoDevice, "no Vulkan device is usable");
  return *first;
}

Expected<Device> open_test_device() {
  const auto info = find_test_device();
  if (!info) return std::unexpected(info.error());
  return Device::open(*info, {.validation = true});
}

const Expected<Device>& shared_device() {
  static const Expected<Device> kDevice = open_test_device();
  return kDevice;
}

}  // namespace

void VulkanTest::SetUp() {
  if (shared_device()) return;
  if (environment("QUORUM_REQUIRE_DEVICE") == "1") FAIL() << shared_device().error().message;
  GTEST_SKIP() << shared_device().error().message;
}

void VulkanTest::TearDown() {
  if (!shared_device()) return;
  for (const std::string& message : device().take_validation_messages()) ADD_FAILURE() << message;
}

const Device& VulkanTest::device() { return *shared_device(); }

}  // namespace quorum
