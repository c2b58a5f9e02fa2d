#include "host/device.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <optional>

#include "host/device_choice.h"
#include "host/state.h"
#include "host/vulkan.h"
#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

// Hides all Vulkan drivers from the loader while it lives.
class NoDrivers {
 public:
  NoDrivers() {
    for (Variable& variable : variables_) {
      if (const char* value = std::getenv(variable.name)) variable.before = value;
      setenv(variable.name, "/nonexistent/driver.json", 1);
    }
  }
  ~NoDrivers() {
    for (const Variable& variable : variables_) {
      if (variable.before) {
        setenv(variable.name, variable.before->c_str(), 1);
      } else {
        unsetenv(variable.name);
      }
    }
  }
  NoDrivers(const NoDrivers&) = delete;
  NoDrivers& operator=(const NoDrivers&) = delete;

 private:
  struct Variable {
    const char* name;
    std::optional<std::string> before;
  };
  Variable variables_[2] = {{"VK_ICD_FILENAMES", {}}, {"VK_DRIVER_FILES", {}}};
};

class DeviceTest : public VulkanTest {};

TEST_F(DeviceTest, ListHoldsTheOpenedDeviceWithItsLimits) {
  const auto devices = list_devices();
  ASSERT_TRUE(devices) << devices.error().message;
  const DeviceInfo& info = device().info();
  ASSERT_LT(info.index, static_cast<int>(devices->size()));
  EXPECT_EQ((*devices)[static_cast<std::size_t>(info.index)].name, info.name);
  EXPECT_FALSE(info.name.empty());
  EXPECT_FALSE(info.driver_version.empty());
  EXPECT_EQ(info.api_version.substr(0, 2), "1.");
  // What Vulkan 1.1 guarantees at least.
  EXPECT_GE(info.max_storage_buffer_range, 1U << 27);
  EXPECT_GE(info.max_allocation, 1U << 30);
  EXPECT_GE(info.max_work_group_invocations, 128U);
  EXPECT_GE(info.shared_memory_bytes, 16384U);
  EXPECT_LE(info.storage_buffer_alignment, 256U);
  EXPECT_GE(info.subgroup_size, 1U);
  EXPECT_GT(info.largest_device_heap, 0U);
}

TEST_F(DeviceTest, OpensTwiceAtOnce) {
  const auto second = Device::open(device().info());
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->info().name, device().info().name);
}

TEST_F(DeviceTest, ADeviceThatIsGoneIsReported) {
  DeviceInfo other = device().info();
  other.index = 99;
  EXPECT_EQ(Device::open(other).error().kind, ErrorKind::kNoDevice);
  other = device().info();
  other.name = "another device";
  EXPECT_EQ(Device::open(other).error().kind, ErrorKind::kNoDevice);
}

TEST_F(DeviceTest, AnUnusableDeviceIsNotOpened) {
  DeviceInfo broken = device().info();
  broken.defect = "it has Vulkan 1.0";
  const auto opened = Device::open(broken);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("it has Vulkan 1.0"), std::string::npos) << opened.error().message;
}

TEST_F(DeviceTest, ValidationMessagesAreCollected) {
  const auto own = Device::open(device().info(), {.validation = true});
  ASSERT_TRUE(own) << own.error().message;
  EXPECT_TRUE(own->take_validation_messages().empty());
  const auto& vulkan = own->state()->device;
  {
    const vk::raii::Buffer wrong(vulkan,
                                 vk::BufferCreateInfo{.size = 0, .usage = vk::BufferUsageFlagBits::eTransferDst});
  }
  const auto messages = own->take_validation_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages.front().find("VUID-VkBufferCreateInfo-size"), std::string::npos) << messages.front();
  EXPECT_TRUE(own->take_validation_messages().empty());
}

TEST(DeviceList, WithoutADriverTheRemedyIsNamed) {
  const NoDrivers hidden;
  const auto devices = list_devices();
  if (devices) {
    EXPECT_TRUE(devices->empty());
    return;
  }
  EXPECT_EQ(devices.error().kind, ErrorKind::kNoDevice);
  EXPECT_NE(devices.error().message.find("--device cpu"), std::string::npos) << devices.error().message;
}

TEST(DeviceList, WithoutADriverAutoAndCpuAreTheCpu) {
  const NoDrivers hidden;
  for (const char* request : {"auto", "cpu"}) {
    const auto choice = choose_device(request);
    ASSERT_TRUE(choice) << choice.error().message;
    EXPECT_FALSE(choice->device);
    EXPECT_FALSE(choice->reason.empty());
  }
  const auto choice = choose_device("0");
  ASSERT_FALSE(choice);
  EXPECT_EQ(choice.error().kind, ErrorKind::kNoDevice);
}

TEST(VulkanError, KindFollowsTheResult) {
  const auto kind_of = [](auto exception) {
    const auto result = guarded("doing x", [&] { throw exception; });
    EXPECT_EQ(result.error().message.substr(0, 9), "doing x: ");
    return result.error().kind;
  };
  EXPECT_EQ(kind_of(vk::OutOfDeviceMemoryError("call")), ErrorKind::kMemory);
  EXPECT_EQ(kind_of(vk::OutOfHostMemoryError("call")), ErrorKind::kMemory);
  EXPECT_EQ(kind_of(vk::TooManyObjectsError("call")), ErrorKind::kMemory);
  EXPECT_EQ(kind_of(vk::DeviceLostError("call")), ErrorKind::kDevice);
  EXPECT_EQ(kind_of(vk::InitializationFailedError("call")), ErrorKind::kDevice);
}

}  // namespace
}  // namespace quorum
