#include "engine/volume/cell.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(Joined, NeedsTwoDepthsWithinTheStepOfTheNearer) {
  EXPECT_TRUE(joined(2.0F, 2.25F, 0.125F, 1.0F));
  EXPECT_TRUE(joined(2.25F, 2.0F, 0.125F, 1.0F));
  EXPECT_FALSE(joined(2.0F, 2.26F, 0.125F, 1.0F));
  EXPECT_TRUE(joined(2.0F, 2.26F, 0.125F, 1.5F));
  EXPECT_FALSE(joined(0.0F, 0.0F, 0.125F, 1.0F));
  EXPECT_FALSE(joined(0.0F, 2.0F, 100.0F, 1.0F));
}

}  // namespace
}  // namespace quorum
