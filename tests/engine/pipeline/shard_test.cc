#include "engine/pipeline/shard.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(Shard, EveryItemIsInOneShardAlone) {
  for (const int count : {1, 2, 7, 100}) {
    std::size_t before = 0;
    for (int index = 0; index < count; ++index) {
      const auto [begin, end] = Shard{index, count}.range(31);
      EXPECT_EQ(begin, before);
      before = end;
    }
    EXPECT_EQ(before, 31U);
    for (int item = 0; item < 31; ++item) {
      int times = 0;
      for (int index = 0; index < count; ++index) times += Shard{index, count}.has(item) ? 1 : 0;
      EXPECT_EQ(times, 1);
    }
  }
}

TEST(Shard, TextCountsFromOne) {
  EXPECT_EQ(parse_shard("3/7"), (Shard{2, 7}));
  EXPECT_EQ((Shard{2, 7}).text(), "3/7");
  for (const char* wrong : {"", "/", "0/7", "8/7", "3", "3/", "/7", "3/7/9", "+3/7", "3 /7", "1/10001"})
    EXPECT_FALSE(parse_shard(wrong)) << wrong;
}

}  // namespace
}  // namespace quorum
