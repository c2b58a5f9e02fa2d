// What the parity tests share: one dispatch of a kernel, and the comparison that names the first value that differs.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "tests/support/vulkan_test.h"

namespace quorum {

class ParityTest : public VulkanTest {
 protected:
  static Kernel kernel(std::string_view name, const std::vector<SpecConstant>& constants = {}) {
    return Kernel::create(device(), find_kernel(name), constants).value();
  }
  static Kernel test_kernel(std::string_view name) {
    return Kernel::create(device(), find_kernel(name, test_kernel_table())).value();
  }
  static Commands make_commands() { return Commands::create(device()).value(); }
  static void submit(Commands& commands) {
    const auto done = commands.submit();
    if (!done) ADD_FAILURE() << done.error().message;
  }
  /// One dispatch, done when it returns.
  template <typename Params>
  static void run(const Kernel& kernel, const Threads& threads, const Params& params,
                  std::initializer_list<BufferView> buffers) {
    Commands commands = make_commands();
    commands.dispatch(kernel, threads, params, buffers);
    submit(commands);
  }
};

/// Compares values word by word. width: values in a row, for the message. False after a failure.
template <PlainValues Range>
bool same_words(const Range& on_device, const Range& twin, int width, const std::string& what) {
  using T = std::ranges::range_value_t<Range>;
  using Words = std::array<std::uint32_t, sizeof(T) / 4>;
  static_assert(sizeof(T) == sizeof(Words));
  if (on_device.size() != twin.size()) {
    ADD_FAILURE() << what << ": " << on_device.size() << " values on the device, " << twin.size() << " on the CPU";
    return false;
  }
  for (std::size_t index = 0; index < twin.size(); ++index) {
    const Words a = std::bit_cast<Words>(on_device[index]);
    const Words b = std::bit_cast<Words>(twin[index]);
    for (std::size_t word = 0; word < a.size(); ++word) {
      if (a[word] == b[word]) continue;
      const auto row = static_cast<std::size_t>(width);
      ADD_FAILURE() << fmt::format(
          "{}: pixel ({}, {}) word {}: {:#010x} ({:.9g}) on the device, {:#010x} ({:.9g}) on "
          "the CPU",
          what, index % row, index / row, word, a[word], std::bit_cast<float>(a[word]), b[word],
          std::bit_cast<float>(b[word]));
      return false;
    }
  }
  return true;
}

/// Expects that a share of the values, of some that count, is neither tiny nor everything.
inline void expect_share(std::int64_t part, std::int64_t whole, double low, double high, const std::string& what) {
  const double share = whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  EXPECT_GE(share, low) << "trivial input: " << what << ", " << part << " of " << whole;
  EXPECT_LE(share, high) << "trivial input: " << what << ", " << part << " of " << whole;
}

}  // namespace quorum
