#include "host/commands.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <numeric>
#include <vector>

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

struct SaxpyParams {
  std::uint32_t count;
  float a;
};

struct BoxParams {
  std::uint32_t width, height, depth;
};

class CommandsTest : public VulkanTest {
 protected:
  static Kernel kernel(std::string_view name, const std::vector<SpecConstant>& constants = {}) {
    return Kernel::create(device(), find_kernel(name, test_kernel_table()), constants).value();
  }
};

void expect_success(const Expected<void>& done) { EXPECT_TRUE(done) << done.error().message; }

TEST_F(CommandsTest, SaxpyIsRightForCountsThatFillNoGroup) {
  const Kernel saxpy = kernel("saxpy");
  auto commands = Commands::create(device()).value();
  for (const int count : {1, 63, 64, 65, 1000}) {
    std::vector<float> x(count);
    std::iota(x.begin(), x.end(), 0.0F);
    const Buffer x_buffer = buffer_of(x);
    const Buffer y_buffer = buffer_of(std::vector<float>(count, 10.0F));
    commands.dispatch(saxpy, {count}, SaxpyParams{static_cast<std::uint32_t>(count), 2.0F}, {x_buffer, y_buffer});
    expect_success(commands.submit());
    const auto y = content<float>(y_buffer);
    for (int i = 0; i < count; ++i) ASSERT_EQ(y[i], 2.0F * x[i] + 10.0F) << i << " of " << count;
  }
}

TEST_F(CommandsTest, EveryThreadOfABoxRunsOnce) {
  auto commands = Commands::create(device()).value();
  for (const std::uint32_t group_width : {1U, 8U, 32U}) {
    const Kernel number = kernel("number_threads", {{"kGroupWidth", group_width}, {"local_size_y", 2}, {"kStep", 10}});
    const Buffer cells = buffer_of(std::vector<std::uint32_t>(37 * 11 * 5, 0));
    commands.dispatch(number, {37, 11, 5}, BoxParams{37, 11, 5}, {cells});
    expect_success(commands.submit());
    const auto values = content<std::uint32_t>(cells);
    for (std::uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 1 + 10 * i) << "width " << group_width;
  }
}

TEST_F(CommandsTest, GroupWidthHasItsDefaultInTheShaderAndInTheDispatch) {
  const Kernel number = kernel("number_threads");
  const Buffer cells = buffer_of(std::vector<std::uint32_t>(100, 0));
  auto commands = Commands::create(device()).value();
  commands.dispatch(number, {100}, BoxParams{100, 1, 1}, {cells});
  expect_success(commands.submit());
  const auto values = content<std::uint32_t>(cells);
  for (std::uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 1 + 1000 * i);
}

TEST_F(CommandsTest, DependentDispatchesSeeEachOthersResults) {
  constexpr std::uint32_t kCount = 100'000;
  const Kernel step = kernel("reverse_and_increment");
  std::vector<std::uint32_t> start(kCount);
  std::iota(start.begin(), start.end(), 0U);
  const Buffer a = buffer_of(start);
  const Buffer b = buffer_of(std::vector<std::uint32_t>(kCount, 0));
  auto commands = Commands::create(device()).value();
  // 80 dispatches of two buffers need more than one descriptor pool.
  for (int i = 0; i < 40; ++i) {
    commands.dispatch(step, {kCount}, kCount, {a, b});
    commands.dispatch(step, {kCount}, kCount, {b, a});
  }
  expect_success(commands.submit());
  const auto result = content<std::uint32_t>(a);
  for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(result[i], start[i] + 80);
}

TEST_F(CommandsTest, ParamsAndConstantsArriveWhole) {
  struct Params {
    std::int32_t first = -7;
    std::uint32_t second = 0xfedcba98U;
    float third = 0.1F;
    std::array<float, 9> neighbor_from_reference = {1, -2, 3, -4, 5e-20F, 6, 7e20F, 8, 9};
  };
  const Params sent;
  const Kernel echo =
      kernel("echo_params", {{"kWindow", 7}, {"kScale", std::bit_cast<std::uint32_t>(0.3F)}, {"kMasked", 1}});
  const Buffer words = buffer_of(std::vector<std::uint32_t>(15, 0));
  auto commands = Commands::create(device()).value();
  commands.dispatch(echo, {}, sent, {words});
  expect_success(commands.submit());
  const auto received = content<std::uint32_t>(words);
  const auto expected = std::bit_cast<std::array<std::uint32_t, 12>>(sent);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(received[i], expected[i]) << "word " << i;
  EXPECT_EQ(received[12], 7U);
  EXPECT_EQ(received[13], std::bit_cast<std::uint32_t>(0.3F));
  EXPECT_EQ(received[14], 1U);
}

TEST_F(CommandsTest, AViewIsAllThatAKernelTouches) {
  const auto alignment = static_cast<std::uint32_t>(device().info().storage_buffer_alignment);
  const std::uint32_t words = std::max(alignment, 4U) / 4;
  const Kernel number = kernel("number_threads", {{"kStep", 0}});
  const Buffer cells = buffer_of(std::vector<std::uint32_t>(3 * words, 0));
  auto commands = Commands::create(device()).value();
  commands.dispatch(number, {words}, BoxParams{words, 1, 1}, {BufferView(cells, 4 * words, 4 * words)});
  expect_success(commands.submit());
  std::vector<std::uint32_t> expected(3 * words, 0);
  std::fill_n(expected.begin() + words, words, 1);
  EXPECT_EQ(content<std::uint32_t>(cells), expected);
}

TEST_F(CommandsTest, TexelsAreReadInFours) {
  const Kernel sum_texels = kernel("sum_texels");
  std::vector<std::uint32_t> words(1000);
  for (std::uint32_t i = 0; i < words.size(); ++i) words[i] = i * i;
  const Buffer texels = buffer_of(words);
  const Buffer sums = buffer_of(std::vector<std::uint32_t>(250, 0));
  auto commands = Commands::create(device()).value();
  commands.dispatch(sum_texels, {250}, 250U, {texels, sums});
  expect_success(commands.submit());
  std::vector<std::uint32_t> expected(250);
  for (std::uint32_t i = 0; i < expected.size(); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) expected[i] += words[4 * i + k] + (k == 0 ? i : 0);
  EXPECT_EQ(content<std::uint32_t>(sums), expected);
}

TEST_F(CommandsTest, AnEmptyBufferCanBeBound) {
  const Kernel saxpy = kernel("saxpy");
  const Buffer empty = Buffer::create(device(), 0).value();
  auto commands = Commands::create(device()).value();
  commands.dispatch(saxpy, {64}, SaxpyParams{0, 2.0F}, {empty, empty});
  expect_success(commands.submit());
}

TEST_F(CommandsTest, FillZeroTakesItsPlaceBetweenDispatches) {
  const Kernel number = kernel("number_threads", {{"kStep", 0}});
  const Buffer cells = buffer_of(std::vector<std::uint32_t>(8, 5));
  auto commands = Commands::create(device()).value();
  commands.fill_zero(cells);
  commands.dispatch(number, {8}, BoxParams{8, 1, 1}, {cells});
  commands.fill_zero({cells, 8, 12});
  commands.dispatch(number, {8}, BoxParams{8, 1, 1}, {cells});
  expect_success(commands.submit());
  EXPECT_EQ(content<std::uint32_t>(cells), (std::vector<std::uint32_t>{2, 2, 1, 1, 1, 2, 2, 2}));
}

TEST_F(CommandsTest, CopyTakesItsPlaceBetweenDispatches) {
  const Kernel number = kernel("number_threads", {{"kStep", 0}});
  const Buffer cells = buffer_of(std::vector<std::uint32_t>(8, 5));
  const Buffer before = buffer_of(std::vector<std::uint32_t>(8, 0));
  auto commands = Commands::create(device()).value();
  commands.fill_zero(cells);
  commands.dispatch(number, {8}, BoxParams{8, 1, 1}, {cells});
  commands.copy(cells, before);
  commands.dispatch(number, {8}, BoxParams{8, 1, 1}, {cells});
  expect_success(commands.submit());
  EXPECT_EQ(content<std::uint32_t>(before), std::vector<std::uint32_t>(8, 1));
  EXPECT_EQ(content<std::uint32_t>(cells), std::vector<std::uint32_t>(8, 2));
}

TEST_F(CommandsTest, RegionsAreTimedUnderTheirNames) {
  const Kernel spin = kernel("spin");
  const Buffer sum = buffer_of(std::vector<std::uint32_t>{0});
  auto warm_up = Commands::create(device()).value();  // drivers may compile at the first dispatch
  warm_up.dispatch(spin, {64}, 1U, {sum});
  expect_success(warm_up.submit());

  auto commands = Commands::create(device()).value();
  double whole = 0.0;
  for (int i = 0; i < 3; ++i) {
    commands.region("never used");
    commands.region("short");
    commands.dispatch(spin, {64}, 100U, {sum});
    commands.region("long");
    commands.dispatch(spin, {4096}, 60'000U, {sum});
    commands.dispatch(spin, {4096}, 60'000U, {sum});
    expect_success(commands.submit());
    whole += commands.last_submission_seconds();
  }
  const auto& timings = commands.timings();
  if (timings.empty()) GTEST_SKIP() << "the queue has no timestamps";
  ASSERT_EQ(timings.size(), 2U);
  EXPECT_EQ(timings[0].name, "short");
  EXPECT_EQ(timings[1].name, "long");
  EXPECT_EQ(timings[1].count, 3);
  EXPECT_GT(timings[0].seconds, 0.0);
  EXPECT_GT(timings[1].seconds, 3.0 * timings[0].seconds);
  EXPECT_LT(timings[1].seconds, 60.0);
  EXPECT_NEAR(timings[0].seconds + timings[1].seconds, whole, 1e-9);
}

TEST_F(CommandsTest, ARegionLastsOverSubmissions) {
  const Kernel spin = kernel("spin");
  const Buffer sum = buffer_of(std::vector<std::uint32_t>{0});
  auto commands = Commands::create(device()).value();
  commands.region("spin");
  for (int i = 0; i < 4; ++i) {
    commands.dispatch(spin, {64}, 10U, {sum});
    expect_success(commands.submit());
  }
  if (commands.timings().empty()) GTEST_SKIP() << "the queue has no timestamps";
  ASSERT_EQ(commands.timings().size(), 1U);
  EXPECT_EQ(commands.timings()[0].count, 4);
}

TEST_F(CommandsTest, NothingRecordedIsNothingDone) {
  auto commands = Commands::create(device()).value();
  expect_success(commands.submit());
  const Kernel saxpy = kernel("saxpy");
  const Buffer x = buffer_of(std::vector{1.0F});
  commands.dispatch(saxpy, {0}, SaxpyParams{1, 1.0F}, {x, x});
  expect_success(commands.submit());
  EXPECT_EQ(content<float>(x), std::vector{1.0F});
  EXPECT_TRUE(commands.timings().empty());
}

TEST_F(CommandsTest, TooManyWorkGroupsFailAtSubmitAndLeaveTheCommandsUsable) {
  const Kernel saxpy = kernel("saxpy");
  const Buffer x = buffer_of(std::vector{1.0F});
  const Buffer y = buffer_of(std::vector{1.0F});
  auto commands = Commands::create(device()).value();
  commands.dispatch(saxpy, {1}, SaxpyParams{1, 1.0F}, {x, y});
  commands.dispatch(saxpy, {std::int64_t{1} << 50}, SaxpyParams{1, 1.0F}, {x, y});
  const auto done = commands.submit();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kDevice);
  EXPECT_NE(done.error().message.find("saxpy"), std::string::npos) << done.error().message;
  EXPECT_EQ(content<float>(y), std::vector{1.0F});

  commands.dispatch(saxpy, {1}, SaxpyParams{1, 4.0F}, {x, y});
  expect_success(commands.submit());
  EXPECT_EQ(content<float>(y), std::vector{5.0F});
}

constexpr std::uint64_t kTooLarge = std::uint64_t{1} << 60;

TEST_F(CommandsTest, TheFirstFailureIsToldOnceAndNothingRunsAfterIt) {
  const Kernel saxpy = kernel("saxpy");
  const Buffer x = buffer_of(std::vector{3.0F});
  Buffer y = buffer_of(std::vector{1.0F});
  auto commands = Commands::create(device()).value();
  commands.dispatch(saxpy, {1}, SaxpyParams{1, 1.0F}, {x, y});  // recorded, but never run
  const Buffer none = commands.allocate(kTooLarge);
  Buffer after = commands.upload(std::vector{5.0F});
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(after.size(), 0U);
  EXPECT_EQ(commands.allocate_zeros(2 * kTooLarge).size(), 0U);
  EXPECT_TRUE(commands.kernel("range_surface").empty());
  commands.upload(std::vector{7.0F}, y, 0);
  commands.upload(std::vector{7.0F}, after, 0);
  commands.copy(x, y);
  commands.copy(none, y);
  commands.fill_zero(y);
  commands.fill_zero(none);
  commands.dispatch(saxpy, {1}, SaxpyParams{1, 1.0F}, {x, none});
  commands.dispatch(Kernel(), {1}, {y});
  const auto done = commands.submit();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kMemory);
  EXPECT_NE(done.error().message.find(fmt::format("({} bytes)", kTooLarge)), std::string::npos) << done.error().message;
  EXPECT_EQ(content<float>(y), std::vector{1.0F});
  EXPECT_TRUE(commands.timings().empty());

  expect_success(commands.submit());
  commands.dispatch(saxpy, {1}, SaxpyParams{1, 2.0F}, {x, y});
  expect_success(commands.submit());
  EXPECT_EQ(content<float>(y), std::vector{7.0F});
}

TEST_F(CommandsTest, AFailureToMakeAKernelIsTheFirst) {
  auto commands = Commands::create(device()).value();
  const std::uint32_t too_many = device().info().max_work_group_invocations + 1;
  EXPECT_TRUE(commands.kernel("sweep_depth", {{"kGroupSize", too_many}}).empty());
  static_cast<void>(commands.allocate(kTooLarge));
  const auto done = commands.submit();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kDevice);
  EXPECT_NE(done.error().message.find("kernel sweep_depth"), std::string::npos) << done.error().message;
  EXPECT_FALSE(commands.kernel("range_surface").empty());
}

TEST_F(CommandsTest, ADownloadRunsWhatWasRecorded) {
  const Kernel saxpy = kernel("saxpy");
  auto commands = Commands::create(device()).value();
  const Buffer x = commands.upload(std::vector{3.0F, 4.0F});
  Buffer y = commands.allocate_zeros(2 * sizeof(float));
  commands.upload(std::vector{10.0F}, y, sizeof(float));
  commands.dispatch(saxpy, {2}, SaxpyParams{2, 2.0F}, {x, y});
  std::array<float, 2> received = {};
  expect_success(commands.download(y, received));
  EXPECT_EQ(received, (std::array{6.0F, 18.0F}));
}

TEST_F(CommandsTest, ADownloadAfterAFailureTellsItAndLeavesTheValues) {
  auto commands = Commands::create(device()).value();
  const Buffer none = commands.allocate(kTooLarge);
  std::array received = {1.0F, 2.0F};
  const auto done = commands.download(none, received);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kMemory);
  EXPECT_EQ(received, (std::array{1.0F, 2.0F}));
}

TEST_F(CommandsTest, ASubmissionBeyondItsTimeoutFailsAndTheNextOneWorks) {
  const Kernel spin = kernel("spin");
  const Buffer sum = buffer_of(std::vector<std::uint32_t>{0});
  auto commands = Commands::create(device(), {.timeout = std::chrono::microseconds(50)}).value();
  commands.region("spinning");
  commands.dispatch(spin, {20'000}, 60'000U, {sum});
  const auto done = commands.submit();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kDevice);
  EXPECT_NE(done.error().message.find("running spinning"), std::string::npos) << done.error().message;

  const Kernel saxpy = kernel("saxpy");
  const Buffer x = buffer_of(std::vector{3.0F});
  const Buffer y = buffer_of(std::vector{1.0F});
  auto patient = Commands::create(device()).value();
  patient.dispatch(saxpy, {1}, SaxpyParams{1, 2.0F}, {x, y});
  expect_success(patient.submit());
  EXPECT_EQ(content<float>(y), std::vector{7.0F});
}

class CommandsDeathTest : public CommandsTest {};

TEST_F(CommandsDeathTest, ACallThatDoesNotFitTheKernelStops) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const Kernel saxpy = kernel("saxpy");
  const Buffer x = buffer_of(std::vector<float>(256, 1.0F));
  auto commands = Commands::create(device()).value();
  EXPECT_DEATH(commands.dispatch(saxpy, {1}, SaxpyParams{1, 1.0F}, {x}), "layout.buffer_count");
  EXPECT_DEATH(commands.dispatch(saxpy, {1}, 1.0F, {x, x}), "layout.push_constant_size");
  EXPECT_DEATH(commands.dispatch(saxpy, {1}, {x, x}), "layout.push_constant_size");
  EXPECT_DEATH(commands.dispatch(saxpy, {-1}, SaxpyParams{1, 1.0F}, {x, x}), "threads.x");
  EXPECT_DEATH(commands.dispatch(saxpy, {1}, SaxpyParams{1, 1.0F}, {x, BufferView(x, 512, 600)}), "view.size");
}

}  // namespace
}  // namespace quorum
