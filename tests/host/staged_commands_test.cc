// Commands on a device whose memory the host doesn't see: values go there and back through staging buffers.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "engine/image/padded_image.h"
#include "host/commands.h"
#include "host/residents.h"
#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

struct SaxpyParams {
  std::uint32_t count;
  float a;
};

class StagedCommands : public VulkanTest {
 protected:
  void SetUp() override {
    VulkanTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    staged_.emplace(Device::open(device().info(), {.validation = true, .force_staging = true}).value());
    commands_.emplace(Commands::create(*staged_).value());
  }
  void TearDown() override {
    VulkanTest::TearDown();
    commands_.reset();
    if (!staged_) return;
    for (const std::string& message : staged_->take_validation_messages()) ADD_FAILURE() << message;
  }

  Commands& commands() { return *commands_; }
  [[nodiscard]] DeviceWork work() const { return staged_->work(); }
  Kernel saxpy() { return Kernel::create(*staged_, find_kernel("saxpy", test_kernel_table())).value(); }

  Residents<PaddedImage> resident_images(std::uint64_t most_bytes) {
    return {most_bytes, [this](const PaddedImage& image) { return std::vector{commands().upload(image.pixels)}; }};
  }

  template <typename T>
  std::vector<T> read(const Buffer& buffer) {
    std::vector<T> values(buffer.size() / sizeof(T));
    const auto done = commands().download(buffer, values);
    if (!done) ADD_FAILURE() << done.error().message;
    return values;
  }

 private:
  std::optional<Device> staged_;
  std::optional<Commands> commands_;
};

TEST_F(StagedCommands, UploadsAndADownloadShareTheSubmissionOfADispatch) {
  const Kernel kernel = saxpy();
  const Buffer y = commands().upload(std::vector<float>(100, 1.0F));
  for (int i = 0; i < 3; ++i) {
    const Buffer x = commands().upload(std::vector<float>(100, static_cast<float>(i)));  // gone before it is read
    commands().dispatch(kernel, {100}, SaxpyParams{100, 2.0F}, {x, y});
  }
  EXPECT_EQ(work().submissions, 0U);
  EXPECT_EQ(read<float>(y), std::vector<float>(100, 7.0F));
  EXPECT_EQ(work().submissions, 1U);
  EXPECT_EQ(work().dispatches, 3U);
  EXPECT_EQ(work().uploaded_bytes, 1600U);
  EXPECT_EQ(work().downloaded_bytes, 400U);
  EXPECT_GT(commands().last_submission_seconds(), 0.0);
}

TEST_F(StagedCommands, ValuesBeyondTheStagingBufferArriveWhole) {
  std::vector<std::uint32_t> sent((41U << 20) / 4 + 1);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint32_t>(i) * 2654435761U;
  const Buffer small = commands().upload(std::vector<std::uint32_t>{1, 2, 3});
  const Buffer large = commands().upload(sent);
  EXPECT_EQ(read<std::uint32_t>(large) == sent, true);
  EXPECT_EQ(read<std::uint32_t>(small), (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST_F(StagedCommands, MemoryIsUsedAgainAndZeroWhereItIsToBe) {
  const std::vector<std::uint32_t> ones(5000, ~0U);
  EXPECT_EQ(read<std::uint32_t>(commands().upload(ones)), ones);
  const std::uint64_t before = work().allocations;
  for (int i = 0; i < 5; ++i) {
    Buffer zeros = commands().allocate_zeros(5000 * sizeof(std::uint32_t));
    EXPECT_EQ(read<std::uint32_t>(zeros), std::vector<std::uint32_t>(5000, 0U));
    commands().upload(ones, zeros, 0);
    EXPECT_EQ(read<std::uint32_t>(zeros), ones);
  }
  EXPECT_EQ(work().allocations, before);
}

TEST_F(StagedCommands, ACopyLandsWhereItIsTold) {
  const Buffer whole = commands().upload(std::vector<std::uint32_t>(5, 9));
  const Buffer part = commands().upload(std::vector<std::uint32_t>{1, 2});
  commands().copy(part, whole, 8);
  EXPECT_EQ(read<std::uint32_t>(whole), (std::vector<std::uint32_t>{9, 9, 1, 2, 9}));
}

TEST_F(StagedCommands, AnImageIsUploadedOnceWhileTheHostHasIt) {
  Residents<PaddedImage> images = resident_images(1000);
  const auto make = [](Rgba color) {
    return std::make_shared<const PaddedImage>(PaddedImage{4, 4, std::vector<Rgba>(25, color)});
  };
  auto first = make(1);
  const auto second = make(2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(read<Rgba>(images.of(first).front()), first->pixels);
    EXPECT_EQ(read<Rgba>(images.of(second).front()), second->pixels);
  }
  EXPECT_EQ(work().uploaded_bytes, 200U);
  first = make(3);  // the one before is gone
  EXPECT_EQ(read<Rgba>(images.of(first).front()), first->pixels);
  EXPECT_EQ(work().uploaded_bytes, 300U);
}

TEST_F(StagedCommands, TheImageUsedLeastRecentlyGoesFirst) {
  Residents<PaddedImage> images = resident_images(250);  // two of them
  std::vector<std::shared_ptr<const PaddedImage>> all;
  for (Rgba color = 0; color < 3; ++color)
    all.push_back(std::make_shared<const PaddedImage>(PaddedImage{4, 4, std::vector<Rgba>(25, color)}));
  for (const int index : {0, 1, 0, 2, 0}) images.of(all[static_cast<std::size_t>(index)]);
  EXPECT_EQ(work().uploaded_bytes, 300U);
  images.of(all[1]);
  EXPECT_EQ(work().uploaded_bytes, 400U);
  Residents<PaddedImage> none = resident_images(0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(read<Rgba>(none.of(all[0]).front()), all[0]->pixels);
  EXPECT_EQ(work().uploaded_bytes, 600U);
}

}  // namespace
}  // namespace quorum
