// What tests on a device share: the device, and the proof that the validation layer had nothing to say.
#pragma once

#include <gtest/gtest.h>

#include <span>

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
};

}  // namespace quorum
