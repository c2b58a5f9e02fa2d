#include "host/device_rates.h"

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

class DeviceRatesTest : public VulkanTest {};

TEST_F(DeviceRatesTest, AreWithinWhatDevicesDo) {
  const auto rates = measure_device_rates(device());
  ASSERT_TRUE(rates) << rates.error().message;
  EXPECT_GT(rates->operations_per_second, 1e8);
  EXPECT_LT(rates->operations_per_second, 1e15);
  EXPECT_GT(rates->bytes_per_second, 1e8);
  EXPECT_LT(rates->bytes_per_second, 1e14);
}

}  // namespace
}  // namespace quorum
