#include "host/memory_pool.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

Allocation memory_of(std::uint64_t bytes) {
  Allocation made;
  made.bytes = bytes;
  return made;
}

TEST(MemoryPool, LargeSizesAreRoundedUpByAnEighthAtMost) {
  EXPECT_EQ(MemoryPool::size_class(1), 1024U);
  EXPECT_EQ(MemoryPool::size_class(1025), 2048U);
  for (std::uint64_t bytes = 1024; bytes < (1ULL << 33); bytes = bytes * 5 / 4 + 3) {
    const std::uint64_t size = MemoryPool::size_class(bytes);
    EXPECT_GE(size, bytes);
    EXPECT_LE(size, bytes > (4 << 20) ? bytes + bytes / 8 : 2 * bytes);
    EXPECT_EQ(MemoryPool::size_class(size), size);
  }
}

TEST(MemoryPool, GivesWhatItWasGiven) {
  MemoryPool pool;
  pool.set_limit(10'000);
  pool.give(memory_of(2048));
  EXPECT_FALSE(pool.take(1024));
  ASSERT_TRUE(pool.take(2048));
  EXPECT_FALSE(pool.take(2048));
}

TEST(MemoryPool, KeepsNoMoreThanItsLimit) {
  MemoryPool pool;
  pool.set_limit(5000);
  pool.give(memory_of(1024));
  pool.give(memory_of(4096));  // 5120 with the first, which goes
  EXPECT_FALSE(pool.take(1024));
  EXPECT_TRUE(pool.take(4096));
  pool.give(memory_of(8192));
  EXPECT_FALSE(pool.take(8192));
  EXPECT_FALSE(pool.clear());
  pool.give(memory_of(1024));
  EXPECT_TRUE(pool.clear());
  EXPECT_FALSE(pool.take(1024));
}

}  // namespace
}  // namespace quorum
