#include "host/device_choice.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

constexpr std::uint64_t kGiB = 1ULL << 30;

DeviceInfo make_device(int index, std::string name, DeviceKind kind, std::uint64_t heap, std::string defect = "") {
  DeviceInfo info;
  info.index = index;
  info.name = std::move(name);
  info.kind = kind;
  info.largest_device_heap = heap;
  info.defect = std::move(defect);
  return info;
}

const DeviceInfo kSoftware = make_device(0, "llvmpipe (LLVM 15.0.6, 256 bits)", DeviceKind::kSoftware, 64 * kGiB);

std::vector<DeviceInfo> workstation() {
  return {kSoftware,
          make_device(1, "Intel UHD 770", DeviceKind::kIntegrated, 32 * kGiB),
          make_device(2, "NVIDIA GeForce RTX 3060", DeviceKind::kDiscrete, 12 * kGiB),
          make_device(3, "NVIDIA GeForce RTX 4090", DeviceKind::kDiscrete, 24 * kGiB),
          make_device(4, "NVIDIA Tesla K10", DeviceKind::kDiscrete, 48 * kGiB, "it has Vulkan 1.0"),
          make_device(5, "Virtio Venus", DeviceKind::kVirtual, 99 * kGiB)};
}

int chosen_index(std::string_view request, std::span<const DeviceInfo> devices) {
  const auto choice = choose_device(request, devices);
  if (!choice) ADD_FAILURE() << choice.error().message;
  return choice && choice->device ? choice->device->index : -1;
}

std::string refusal(std::string_view request, std::span<const DeviceInfo> devices) {
  const auto choice = choose_device(request, devices);
  if (choice) return "not refused";
  EXPECT_EQ(choice.error().kind, ErrorKind::kNoDevice);
  EXPECT_EQ(choice.error().message.find('\n'), std::string::npos);
  return choice.error().message;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(DeviceChoice, AutoTakesTheUsableDiscreteGpuWithTheLargestMemory) {
  EXPECT_EQ(chosen_index("auto", workstation()), 3);
}

TEST(DeviceChoice, AutoPrefersIntegratedToVirtualWhateverTheMemory) {
  auto devices = workstation();
  std::erase_if(devices, [](const DeviceInfo& device) { return device.kind == DeviceKind::kDiscrete; });
  EXPECT_EQ(chosen_index("auto", devices), 1);
  devices.erase(devices.begin() + 1);
  EXPECT_EQ(chosen_index("auto", devices), 5);
}

TEST(DeviceChoice, AutoNeverTakesSoftwareVulkan) {
  const auto choice = choose_device("auto", std::vector{kSoftware});
  ASSERT_TRUE(choice);
  EXPECT_FALSE(choice->device);
  EXPECT_TRUE(contains(choice->reason, "twice as fast as software Vulkan")) << choice->reason;
}

TEST(DeviceChoice, AutoWithoutDevicesIsTheCpu) {
  const auto choice = choose_device("auto", {});
  ASSERT_TRUE(choice);
  EXPECT_FALSE(choice->device);
  EXPECT_EQ(choice->reason, "there is no Vulkan GPU");
}

TEST(DeviceChoice, AutoSaysWhyAGpuCannotBeUsed) {
  const std::vector devices = {workstation()[4], kSoftware};
  const auto choice = choose_device("auto", devices);
  ASSERT_TRUE(choice);
  EXPECT_FALSE(choice->device);
  EXPECT_TRUE(contains(choice->reason, "NVIDIA Tesla K10: it has Vulkan 1.0")) << choice->reason;
}

TEST(DeviceChoice, CpuIsTheCpuWhateverThereIs) {
  EXPECT_EQ(chosen_index("cpu", workstation()), -1);
  EXPECT_EQ(chosen_index("cpu", {}), -1);
}

TEST(DeviceChoice, AnIndexOrNamePicksSoftwareToo) {
  EXPECT_EQ(chosen_index("0", workstation()), 0);
  EXPECT_EQ(chosen_index("LLVMpipe", workstation()), 0);
}

TEST(DeviceChoice, PartOfANamePicksWhateverTheCase) {
  EXPECT_EQ(chosen_index("rtx 30", workstation()), 2);
  EXPECT_EQ(chosen_index("INTEL", workstation()), 1);
}

TEST(DeviceChoice, ANumberThatIsNoIndexIsPartOfAName) { EXPECT_EQ(chosen_index("4090", workstation()), 3); }

TEST(DeviceChoice, APartOfDifferentNamesIsRefusedWithTheList) {
  const std::string message = refusal("geforce", workstation());
  EXPECT_TRUE(contains(message, "different names")) << message;
  EXPECT_TRUE(contains(message, "2: NVIDIA GeForce RTX 3060 (discrete GPU)")) << message;
  EXPECT_TRUE(contains(message, "4: NVIDIA Tesla K10 (discrete GPU, not usable)")) << message;
}

TEST(DeviceChoice, AWholeNameWinsOverNamesThatContainIt) {
  const std::vector devices = {make_device(0, "Radeon RX 6600 XT", DeviceKind::kDiscrete, kGiB),
                               make_device(1, "Radeon RX 6600", DeviceKind::kDiscrete, kGiB)};
  EXPECT_EQ(chosen_index("radeon rx 6600", devices), 1);
}

TEST(DeviceChoice, OfSeveralDevicesWithOneNameTheFirstUsableIsTaken) {
  const std::vector devices = {make_device(0, "H100", DeviceKind::kDiscrete, kGiB, "it has no queue"),
                               make_device(1, "H100", DeviceKind::kDiscrete, kGiB),
                               make_device(2, "H100", DeviceKind::kDiscrete, 2 * kGiB)};
  const auto choice = choose_device("h100", devices);
  ASSERT_TRUE(choice && choice->device);
  EXPECT_EQ(choice->device->index, 1);
  EXPECT_TRUE(contains(choice->reason, "the first of 2")) << choice->reason;
}

TEST(DeviceChoice, AnUnusableDeviceIsRefusedWithItsReason) {
  for (const char* request : {"4", "k10"}) {
    const std::string message = refusal(request, workstation());
    EXPECT_TRUE(contains(message, "can't be used: it has Vulkan 1.0")) << message;
  }
}

TEST(DeviceChoice, AnUnknownRequestIsRefusedWithTheList) {
  for (const char* request : {"17", "-1", "geforce 9", "", "99999999999999999999"}) {
    const std::string message = refusal(request, workstation());
    EXPECT_TRUE(contains(message, "no device has this index or name")) << message;
    EXPECT_TRUE(contains(message, "1: Intel UHD 770 (integrated GPU)")) << message;
  }
  EXPECT_TRUE(contains(refusal("0", {}), "there is no Vulkan device"));
}

}  // namespace
}  // namespace quorum
