#include "host/block_buffers.h"

#include <cstdint>
#include <numeric>
#include <utility>

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

constexpr std::uint64_t kKernelSees = 1024;  // bytes of a buffer
constexpr std::size_t kBlockBytes = 96;      // 10 blocks in a buffer

class BlockBuffersTest : public VulkanTest {
 protected:
  void SetUp() override {
    VulkanTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    limited_.emplace(
        Device::open(device().info(), {.validation = true, .max_storage_buffer_range = kKernelSees}).value());
    commands_.emplace(Commands::create(*limited_).value());
  }
  void TearDown() override {
    VulkanTest::TearDown();
    if (!limited_) return;
    for (const std::string& message : limited_->take_validation_messages()) ADD_FAILURE() << message;
  }

  Commands& commands() { return *commands_; }

 private:
  std::optional<Device> limited_;
  std::optional<Commands> commands_;
};

TEST_F(BlockBuffersTest, HoldZerosInBuffersThatKernelsSee) {
  BlockBuffers blocks;
  ASSERT_TRUE(blocks.reset(commands(), 25, kBlockBytes, "blocks"));
  const std::vector<std::uint32_t> all = {0, 9, 10, 24};
  EXPECT_EQ(blocks.first_part(std::span(all), 4).buffer.size(), 10 * kBlockBytes);
  EXPECT_EQ(blocks.first_part(std::span(all).last(1), 1).buffer.size(), 5 * kBlockBytes);
  const auto values = blocks.take<std::uint32_t>(commands(), "blocks");
  ASSERT_TRUE(values) << values.error().message;
  EXPECT_EQ(*values, std::vector<std::uint32_t>(25 * kBlockBytes / 4, 0));
}

TEST_F(BlockBuffersTest, GiveWhatWasWrittenInTheOrderOfBlocks) {
  BlockBuffers blocks;
  ASSERT_TRUE(blocks.reset(commands(), 25, kBlockBytes, "blocks"));
  std::vector<std::uint32_t> sent(25 * kBlockBytes / 4);
  std::iota(sent.begin(), sent.end(), 0U);
  for (const std::uint32_t first : {0U, 10U, 20U}) {
    Buffer buffer = blocks.first_part(std::span(&first, 1), 1).buffer;  // a copy is the same buffer
    commands().upload(std::span(sent).subspan(first * kBlockBytes / 4, buffer.size() / 4), buffer, 0);
  }
  EXPECT_EQ(blocks.take<std::uint32_t>(commands(), "blocks").value(), sent);
}

TEST_F(BlockBuffersTest, PartsEndWithTheirBufferAndAtTheMost) {
  BlockBuffers blocks;
  ASSERT_TRUE(blocks.reset(commands(), 25, kBlockBytes, "blocks"));
  using Entry = std::pair<int, std::uint32_t>;
  const std::vector<Entry> list = {{0, 3}, {0, 8}, {0, 9}, {0, 10}, {0, 24}};
  const auto sizes_for = [&](std::size_t most) {
    std::vector<std::pair<std::size_t, int>> sizes;
    for (std::span<const Entry> rest = list; !rest.empty();) {
      const auto part = blocks.first_part(rest, most, &Entry::second);
      sizes.emplace_back(part.entries.size(), part.first_block);
      rest = rest.subspan(part.entries.size());
    }
    return sizes;
  };
  EXPECT_EQ(sizes_for(100), (std::vector<std::pair<std::size_t, int>>{{3, 0}, {1, 10}, {1, 20}}));
  EXPECT_EQ(sizes_for(2), (std::vector<std::pair<std::size_t, int>>{{2, 0}, {1, 0}, {1, 10}, {1, 20}}));
}

TEST_F(BlockBuffersTest, NoBlocksAreNoValues) {
  BlockBuffers blocks;
  ASSERT_TRUE(blocks.reset(commands(), 0, kBlockBytes, "blocks"));
  EXPECT_TRUE(blocks.take<std::uint32_t>(commands(), "blocks").value().empty());
}

TEST_F(BlockBuffersTest, ABlockThatNoKernelSeesFailsUnderItsName) {
  BlockBuffers blocks;
  const auto done = blocks.reset(commands(), 2, kKernelSees + 4, "three blocks");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kMemory);
  EXPECT_EQ(done.error().message.find("three blocks: a buffer of"), 0U) << done.error().message;
  EXPECT_TRUE(commands().submit());
}

}  // namespace
}  // namespace quorum
