#include "host/batch_size.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(BatchSize, GrowsTwofoldAtMost) {
  BatchSize size(1000, 1, 1 << 30);
  size.measured(1000, BatchSize::kTargetSeconds / 100);
  EXPECT_EQ(size.items(), 2000);
}

TEST(BatchSize, ShrinksAtOnceWhereASubmissionTookTooLong) {
  BatchSize size(1000, 1, 1 << 30);
  size.measured(1000, BatchSize::kTargetSeconds * 10);
  EXPECT_EQ(size.items(), 100);
}

TEST(BatchSize, StaysWithinItsBounds) {
  BatchSize size(5, 100, 200);
  EXPECT_EQ(size.items(), 100);
  for (int i = 0; i < 10; ++i) size.measured(size.items(), 1e-6);
  EXPECT_EQ(size.items(), 200);
  size.measured(200, 1e6);
  EXPECT_EQ(size.items(), 100);
}

TEST(BatchSize, IgnoresWhatWasNotMeasured) {
  BatchSize size(1000, 1, 1 << 30);
  size.measured(1000, 0.0);
  size.measured(0, 1.0);
  EXPECT_EQ(size.items(), 1000);
}

}  // namespace
}  // namespace quorum
