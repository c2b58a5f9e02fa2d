#include "engine/mesh/drop_specks.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

/// A wall at depth 2, a patch of side pixels at depth 1 before it, and what is left of its certainty.
float certainty_of_patch(int side, float certainty, int least_pixels) {
  Grid<float> depth(40, 30, 2.0F);
  Grid<float> certainties(40, 30, 0.1F);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      depth.at(5 + x, 4 + y) = 1.0F;
      certainties.at(5 + x, 4 + y) = certainty;
    }
  }
  drop_specks(depth, 0.01F, least_pixels, certainties);
  EXPECT_EQ(certainties.at(0, 0), 0.1F) << "the wall is large";
  return certainties.at(5, 4);
}

TEST(DropSpecks, SmallPatchesThatNobodyConfirmsGo) {
  EXPECT_EQ(certainty_of_patch(9, 0.25F, 100), 0.0F);
  EXPECT_EQ(certainty_of_patch(10, 0.25F, 100), 0.25F);
  EXPECT_EQ(certainty_of_patch(9, 0.75F, 100), 0.75F) << "confirmed";
  EXPECT_EQ(certainty_of_patch(1, 0.25F, 2), 0.0F);
  EXPECT_EQ(certainty_of_patch(1, 0.25F, 0), 0.25F) << "none go";
}

TEST(DropSpecks, ASurfaceThatTurnsAwayIsOnePatch) {
  Grid<float> depth(20, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) depth.at(x, y) = 2.0F + 0.04F * static_cast<float>(x);  // twice the slope
  Grid<float> certainty(20, 20, 0.25F);
  drop_specks(depth, 0.01F, 100, certainty);
  EXPECT_EQ(certainty.at(7, 7), 0.25F);
  drop_specks(depth, 0.005F, 100, certainty);
  EXPECT_EQ(certainty.at(7, 7), 0.0F) << "columns of 20";
}

TEST(DropSpecks, EmptyMapsStayEmpty) {
  Grid<float> certainty;
  drop_specks({}, 0.01F, 100, certainty);
  EXPECT_TRUE(certainty.empty());
}

}  // namespace
}  // namespace quorum
