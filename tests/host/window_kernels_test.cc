#include "host/window_kernels.h"

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

class WindowKernelsTest : public VulkanTest {};

TEST_F(WindowKernelsTest, AreMadeOnceForEachSize) {
  auto commands = Commands::create(device()).value();
  WindowKernels kernels(commands, "support_windows");
  const Kernel* five = &kernels.at(5);
  EXPECT_FALSE(five->empty());
  EXPECT_NE(&kernels.at(9), five);
  EXPECT_EQ(&kernels.at(5), five);
  EXPECT_TRUE(commands.submit());
}

TEST_F(WindowKernelsTest, AreAskedForAgainAfterAFailure) {
  auto commands = Commands::create(device()).value();
  WindowKernels kernels(commands, "support_windows");
  static_cast<void>(commands.allocate(std::uint64_t{1} << 60));
  EXPECT_TRUE(kernels.at(5).empty());
  EXPECT_FALSE(commands.submit());
  EXPECT_FALSE(kernels.at(5).empty());
}

}  // namespace
}  // namespace quorum
