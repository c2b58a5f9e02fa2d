// What tests on a device share: the device, and the proof that the validation layer had nothing to say.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "host/buffer.h"
#include "host/device.h"
#include "host/kernel_table.h"

namespace quorum {

/// Kernels of tests/host/kernels.
std::span<const KernelCode> test_kernel_table();

/// A test on the device that $QUORUM_TEST_DEVICE names (as --device does), else on the first usable one, software
/// included, with validation on. Any validation message fails the test. Without a device the test is skipped, or fails
/// under QUORUM_REQUIRE_DEVICE=1.
class VulkanTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// The device, opened once per test program.
  static const Device& device();

  /// A buffer on the device that holds values, and what a buffer holds.
  template <PlainValues Range>
  static Buffer buffer_of(const Range& values) {
    return Buffer::of(device(), values).value();
  }
  template <typename T>
  static std::vector<T> content(const Buffer& buffer) {
    std::vector<T> values(buffer.size() / sizeof(T));
    const auto done = buffer.download(values);
    if (!done) ADD_FAILURE() << done.error().message;
    return values;
  }
};

}  // namespace quorum
