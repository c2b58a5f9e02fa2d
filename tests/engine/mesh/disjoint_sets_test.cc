#include "engine/mesh/disjoint_sets.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(DisjointSets, TheLowestNumberStandsForASet) {
  DisjointSets sets(7);
  for (std::uint32_t number = 0; number < 7; ++number) EXPECT_EQ(sets.find(number), number);
  sets.join(6, 4);
  sets.join(4, 5);
  sets.join(2, 3);
  EXPECT_EQ(sets.find(6), 4U);
  EXPECT_EQ(sets.find(5), 4U);
  EXPECT_EQ(sets.find(3), 2U);
  sets.join(5, 3);
  for (std::uint32_t number = 2; number < 7; ++number) EXPECT_EQ(sets.find(number), 2U);
  EXPECT_EQ(sets.find(1), 1U);
}

}  // namespace
}  // namespace quorum
