#include "host/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

using GroupSize = std::array<std::uint32_t, 3>;

KernelLayout layout_of(std::string_view name, const std::vector<SpecConstant>& constants = {}) {
  return reflect_kernel(find_kernel(name, test_kernel_table()), constants);
}

std::uint32_t value_of(const KernelLayout& layout, std::string_view name) {
  const auto place = std::ranges::find(layout.constants, name, &DeclaredConstant::name);
  return place != layout.constants.end() ? place->value : 0xdeadU;
}

TEST(KernelTable, EveryKernelOfTheTableIsReadable) {
  for (const KernelCode& code : kernel_table()) EXPECT_GT(code.words.size(), 5U) << code.name;
  EXPECT_GE(test_kernel_table().size(), 5U);
  for (const KernelCode& code : test_kernel_table()) EXPECT_EQ(code.words.front(), 0x07230203U) << code.name;
}

TEST(KernelLayout, BindingsPushConstantsAndGroupSizeComeFromTheKernel) {
  const KernelLayout saxpy = layout_of("saxpy");
  EXPECT_EQ(saxpy.buffer_count, 2U);
  EXPECT_EQ(saxpy.push_constant_size, 8U);
  EXPECT_EQ(saxpy.group_size, (GroupSize{64, 1, 1}));
  EXPECT_TRUE(saxpy.constants.empty());
  EXPECT_EQ(saxpy.buffers, (std::vector{BufferKind::kStorage, BufferKind::kStorage}));
  const KernelLayout echo = layout_of("echo_params");
  EXPECT_EQ(echo.buffer_count, 1U);
  EXPECT_EQ(echo.push_constant_size, 48U);
}

TEST(KernelLayout, TexelBuffersAreTakenFromTheKernel) {
  const KernelLayout texels = layout_of("sum_texels");
  EXPECT_EQ(texels.buffer_count, 2U);
  EXPECT_EQ(texels.buffers, (std::vector{BufferKind::kTexels, BufferKind::kStorage}));
}

TEST(KernelLayout, ConstantsAreFoundByName) {
  const KernelLayout defaults = layout_of("echo_params");
  ASSERT_EQ(defaults.constants.size(), 3U);
  EXPECT_EQ(defaults.constants[0].id, 1U);
  EXPECT_EQ(value_of(defaults, "kWindow"), 5U);
  EXPECT_EQ(value_of(defaults, "kScale"), std::bit_cast<std::uint32_t>(0.5F));
  EXPECT_EQ(value_of(defaults, "kMasked"), 0U);
  const KernelLayout wanted = layout_of("echo_params", {{"kWindow", 7}, {"kMasked", 1}});
  EXPECT_EQ(value_of(wanted, "kWindow"), 7U);
  EXPECT_EQ(value_of(wanted, "kScale"), std::bit_cast<std::uint32_t>(0.5F));
  EXPECT_EQ(value_of(wanted, "kMasked"), 1U);
}

TEST(KernelLayout, GroupSizeFollowsTheConstants) {
  // kGroupWidth = 8 is the shader's default; the unnamed width that glslang adds under the same id has 1.
  EXPECT_EQ(layout_of("number_threads").group_size, (GroupSize{8, 1, 2}));
  EXPECT_EQ(layout_of("number_threads", {{"kGroupWidth", 16}}).group_size, (GroupSize{16, 1, 2}));
  EXPECT_EQ(layout_of("number_threads", {{"kGroupWidth", 4}, {"local_size_y", 3}}).group_size, (GroupSize{4, 3, 2}));
}

TEST(KernelDeathTest, AnUnknownNameStops) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(layout_of("echo_params", {{"kWindwo", 5}}), "kWindwo against echo_params");
  EXPECT_DEATH(layout_of("no_such_kernel"), "no_such_kernel");
}

class KernelTest : public VulkanTest {};

TEST_F(KernelTest, EachTestKernelIsBuilt) {
  for (const KernelCode& code : test_kernel_table()) {
    const auto kernel = Kernel::create(device(), code);
    ASSERT_TRUE(kernel) << kernel.error().message;
    EXPECT_EQ(kernel->name(), code.name);
  }
}

TEST_F(KernelTest, AWorkGroupBeyondTheDeviceIsRefused) {
  const std::uint32_t limit = device().info().max_work_group_invocations;
  const auto kernel =
      Kernel::create(device(), find_kernel("number_threads", test_kernel_table()), {{"kGroupWidth", limit}});
  ASSERT_FALSE(kernel);
  EXPECT_EQ(kernel.error().kind, ErrorKind::kDevice);
  EXPECT_NE(kernel.error().message.find("number_threads"), std::string::npos) << kernel.error().message;
}

}  // namespace
}  // namespace quorum
