#include "engine/pipeline/memory_budget.h"

#include <gtest/gtest.h>

#include <charconv>
#include <vector>

#include "engine/core/memory.h"
#include "tests/support/sanitizer.h"

namespace quorum {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20;

TEST(MemoryBudget, WhatTheProcessHoldsIsTakenOff) {
  const MemoryBudget budget(resident_bytes() + 256 * kMebibyte);
  const std::uint64_t before = budget.left();
  EXPECT_LE(before, 256 * kMebibyte);
  EXPECT_GT(before, 200 * kMebibyte);
  const std::vector<char> taken(100 * kMebibyte, 1);
  EXPECT_LT(budget.left(), before - 90 * kMebibyte);
  EXPECT_GE(peak_memory_bytes(), 100 * kMebibyte);
}

TEST(MemoryBudget, FreedMemoryIsThereAgain) {
  if (freed_memory_is_kept()) GTEST_SKIP() << "the sanitizer keeps freed memory";
  const MemoryBudget budget(resident_bytes() + 256 * kMebibyte);
  const std::uint64_t before = budget.left();
  { const std::vector<char> taken(100 * kMebibyte, 1); }
  EXPECT_GT(budget.left(), before - 10 * kMebibyte);
}

TEST(MemoryBudget, AutomaticTakesAShareOfWhatIsFree) {
  const MemoryBudget budget(0);
  EXPECT_GT(budget.bytes(), resident_bytes());
  EXPECT_LT(budget.bytes(), resident_bytes() + available_bytes());
}

TEST(MemoryBudget, RefusalNamesABudgetThatWouldDo) {
  const MemoryBudget small(kMebibyte);
  EXPECT_EQ(small.left(), 0U);
  const auto refused = small.require(50 * kMebibyte, "a stage");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
  const std::string& message = refused.error().message;
  EXPECT_TRUE(message.starts_with("a stage needs ")) << message;
  const std::size_t begin = message.find("option memory ") + 14;
  std::uint64_t least = 0;
  std::from_chars(message.data() + begin, message.data() + message.size(), least);
  EXPECT_TRUE(MemoryBudget(least * kMebibyte).require(50 * kMebibyte, "a stage")) << message;
}

TEST(MemoryBudget, RefusalNamesWhatTheRestOfTheRunNeedsToo) {
  MemoryBudget small(kMebibyte);
  small.foresee(4096 * kMebibyte);
  const auto refused = small.require(50 * kMebibyte, "a stage");
  ASSERT_FALSE(refused);
  const std::string& message = refused.error().message;
  const std::size_t begin = message.find("option memory ") + 14;
  std::uint64_t least = 0;
  std::from_chars(message.data() + begin, message.data() + message.size(), least);
  EXPECT_GE(least, 4096U) << message;
}

}  // namespace
}  // namespace quorum
