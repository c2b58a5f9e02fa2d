#include "host/buffer.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

// Each test runs with memory mapped directly, where the device can, and through the staging buffer.
class BufferTest : public VulkanTest, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    VulkanTest::SetUp();
    if (IsSkipped() || HasFatalFailure() || !GetParam()) return;
    auto staged = Device::open(device().info(), {.validation = true, .force_staging = true});
    ASSERT_TRUE(staged) << staged.error().message;
    staged_.emplace(std::move(*staged));
  }
  void TearDown() override {
    VulkanTest::TearDown();
    if (!staged_) return;
    for (const std::string& message : staged_->take_validation_messages()) ADD_FAILURE() << message;
  }

  const Device& tested() { return staged_ ? *staged_ : device(); }

  Buffer make(std::uint64_t size) {
    auto buffer = Buffer::create(tested(), size);
    if (!buffer) ADD_FAILURE() << buffer.error().message;
    return std::move(*buffer);
  }

 private:
  std::optional<Device> staged_;
};

INSTANTIATE_TEST_SUITE_P(Memory, BufferTest, testing::Bool(),
                         [](const auto& test) { return test.param ? "Staged" : "Mapped"; });

std::vector<std::uint8_t> noise(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : bytes) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  return bytes;
}

TEST_P(BufferTest, ReturnsWhatWasUploadedForOddSizesAndSizesBeyondTheStagingBuffer) {
  for (const std::size_t size : {1UL, 2UL, 3UL, 5UL, 4096UL, 65537UL, 16UL << 20, (33UL << 20) + 7UL}) {
    const auto sent = noise(size);
    Buffer buffer = make(size);
    EXPECT_EQ(buffer.size(), size);
    ASSERT_TRUE(buffer.upload(sent));
    std::vector<std::uint8_t> received(size);
    ASSERT_TRUE(buffer.download(received));
    EXPECT_EQ(received == sent, true) << size << " bytes";
  }
}

TEST_P(BufferTest, OfHoldsItsValues) {
  const std::vector<float> sent = {1.5F, -2.0F, 3.25F};
  auto buffer = Buffer::of(tested(), sent);
  ASSERT_TRUE(buffer) << buffer.error().message;
  EXPECT_EQ(buffer->size(), 12U);
  std::array<float, 3> received = {};
  ASSERT_TRUE(buffer->download(received));
  EXPECT_TRUE(std::ranges::equal(received, sent));
}

TEST_P(BufferTest, AnEmptyBufferTakesAndGivesNothing) {
  Buffer buffer = make(0);
  EXPECT_EQ(buffer.size(), 0U);
  std::vector<int> nothing;
  EXPECT_TRUE(buffer.upload(nothing));
  EXPECT_TRUE(buffer.download(nothing));
  EXPECT_TRUE(buffer.fill_zero());
}

TEST_P(BufferTest, OffsetsTouchTheirPartAlone) {
  const auto sent = noise(1000);
  Buffer buffer = make(sent.size());
  ASSERT_TRUE(buffer.upload(sent));
  const std::vector<std::uint8_t> patch = {1, 2, 3};
  ASSERT_TRUE(buffer.upload(patch, 501));
  std::vector<std::uint8_t> around(5);
  ASSERT_TRUE(buffer.download(around, 500));
  EXPECT_EQ(around, (std::vector<std::uint8_t>{sent[500], 1, 2, 3, sent[504]}));
  std::vector<std::uint8_t> last(1);
  ASSERT_TRUE(buffer.download(last, 999));
  EXPECT_EQ(last[0], sent[999]);
}

TEST_P(BufferTest, FillZeroClearsAll) {
  Buffer buffer = make(1001);
  ASSERT_TRUE(buffer.upload(std::vector<std::uint8_t>(1001, 0xff)));
  ASSERT_TRUE(buffer.fill_zero());
  std::vector<std::uint8_t> received(1001, 1);
  ASSERT_TRUE(buffer.download(received));
  EXPECT_EQ(received, std::vector<std::uint8_t>(1001, 0));
}

TEST_P(BufferTest, ABufferBeyondWhatAKernelCanSeeIsRefused) {
  const std::uint64_t limit = std::min(tested().info().max_storage_buffer_range, tested().info().max_allocation);
  const auto buffer = Buffer::create(tested(), limit + 1);
  ASSERT_FALSE(buffer);
  EXPECT_EQ(buffer.error().kind, ErrorKind::kMemory);
  for (const std::uint64_t named : {limit, limit + 1}) {
    EXPECT_NE(buffer.error().message.find(std::to_string(named)), std::string::npos) << buffer.error().message;
  }
}

TEST_P(BufferTest, ABufferThatIsSeenInPartsMayBeLarger) {
  const Device small = Device::open(tested().info(), {.max_storage_buffer_range = 1024}).value();
  EXPECT_FALSE(Buffer::create(small, 1025));
  EXPECT_TRUE(Buffer::create(small, 1025, BufferUse::kInParts));
  EXPECT_FALSE(Buffer::create(small, small.info().max_allocation + 1, BufferUse::kInParts));
}

TEST_P(BufferTest, SurvivesItsDeviceObject) {
  std::optional<Device> own(Device::open(tested().info()).value());
  Buffer buffer = Buffer::of(*own, std::vector{7, 8}).value();
  own.reset();
  std::vector<int> received(2);
  ASSERT_TRUE(buffer.download(received));
  EXPECT_EQ(received, (std::vector{7, 8}));
}

using BufferDeathTest = BufferTest;
INSTANTIATE_TEST_SUITE_P(Memory, BufferDeathTest, testing::Values(false));

TEST_P(BufferDeathTest, ATransferBeyondTheEndStops) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  Buffer buffer = make(8);
  EXPECT_DEATH(static_cast<void>(buffer.upload(std::vector{1, 2, 3})), "check failed");
  EXPECT_DEATH(static_cast<void>(buffer.upload(std::vector{1, 2}, 4)), "check failed");
}

}  // namespace
}  // namespace quorum
