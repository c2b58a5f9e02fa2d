#include "engine/mesh/free_space.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

VoxelGrid lattice_grid() {
  VoxelGrid grid;
  grid.voxel_size = 1.0;
  grid.blocks = {3, 3, 3};
  return grid;
}

/// Voxels of a lattice of 24 x 24 x 24.
class Lattice {
 public:
  /// Sets the voxels of a box, ends included.
  void fill(const std::array<int, 3>& low, const std::array<int, 3>& high) {
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x)
          bits_[lattice_grid().block_index(x / 8, y / 8, z / 8)][static_cast<std::size_t>(z % 8)] |=
              1ULL << (x % 8 + 8 * (y % 8));
  }
  [[nodiscard]] const std::vector<BlockBits>& bits() const { return bits_; }

 private:
  std::vector<BlockBits> bits_ = std::vector<BlockBits>(lattice_grid().block_count());
};

bool contains(const std::vector<BlockBits>& bits, int x, int y, int z) {
  return (bits[lattice_grid().block_index(x / 8, y / 8, z / 8)][static_cast<std::size_t>(z % 8)] >>
              (x % 8 + 8 * (y % 8)) &
          1) != 0;
}

TEST(FreeSpace, WideSpaceAtTheBorderIsFreeAndACavityIsNot) {
  Lattice lattice;
  lattice.fill({0, 0, 0}, {23, 23, 5});
  lattice.fill({8, 8, 10}, {15, 15, 17});
  const auto free = find_free_space(lattice.bits(), lattice_grid(), {});
  Lattice expected;
  expected.fill({0, 0, 0}, {23, 23, 5});
  EXPECT_EQ(free, expected.bits());
}

TEST(FreeSpace, ACameraMakesTheSpaceAroundItFree) {
  Lattice lattice;
  lattice.fill({6, 6, 6}, {17, 17, 17});
  EXPECT_EQ(find_free_space(lattice.bits(), lattice_grid(), {{11.5, 12.5, 12.0}}), lattice.bits());
  EXPECT_EQ(find_free_space(lattice.bits(), lattice_grid(), {{90.0, 12.5, 12.0}}), Lattice().bits());
}

TEST(FreeSpace, TunnelsThinnerThanThreeVoxelsLeadNowhere) {
  for (const int width : {1, 2, 3, 4}) {
    for (int axis = 0; axis < 3; ++axis) {
      Lattice lattice;
      std::array<int, 3> low = {7, 7, 7};
      std::array<int, 3> high = {6 + width, 6 + width, 6 + width};
      const auto along = static_cast<std::size_t>(axis);
      low[along] = 4;
      high[along] = 20;
      lattice.fill(low, high);
      std::array<int, 3> open_low = {0, 0, 0};
      std::array<int, 3> open_high = {23, 23, 23};
      open_high[along] = 5;
      lattice.fill(open_low, open_high);
      const auto free = find_free_space(lattice.bits(), lattice_grid(), {});
      std::array<int, 3> at = {7, 7, 7};
      const auto is_free = [&](int place) {
        at[along] = place;
        return contains(free, at[0], at[1], at[2]);
      };
      EXPECT_TRUE(is_free(5));
      EXPECT_TRUE(is_free(6)) << "the mouth of a gap is free";
      EXPECT_EQ(is_free(8), width >= 3) << width << " along " << axis;
      EXPECT_EQ(is_free(20), width >= 3) << width << " along " << axis;
    }
  }
}

TEST(FreeSpace, NothingOutsideGivesNoFreeSpace) {
  EXPECT_EQ(find_free_space(Lattice().bits(), lattice_grid(), {{1, 1, 1}}), Lattice().bits());
}

}  // namespace
}  // namespace quorum
