#include "engine/mesh/free_space.h"

#include <oneapi/tbb/parallel_for.h>

#include <utility>

namespace quorum {
namespace {

constexpr std::uint64_t kAllVoxels = ~std::uint64_t{0};
constexpr std::uint64_t kFirstColumn = 0x0101010101010101ULL;  // x = 0
constexpr std::uint64_t kLastColumn = kFirstColumn << 7;
constexpr std::uint64_t kFirstRow = 0xffULL;  // y = 0
constexpr std::uint64_t kLastRow = kFirstRow << 56;

/// Grows the voxels within those of the block that are outside, along the lattice, until they grow no more.
void spread(BlockBits& reached, const BlockBits& outside) {
  for (bool grown = true; grown;) {
    const BlockBits before = reached;
    for (std::size_t z = 0; z < reached.size(); ++z) {
      std::uint64_t word = reached[z];
      if (z > 0) word |= reached[z - 1];
      if (z + 1 < reached.size()) word |= reached[z + 1];
      word |= (word & ~kLastColumn) << 1 | (word & ~kFirstColumn) >> 1;
      word |= word << kBlockSide | word >> kBlockSide;
      reached[z] = word & outside[z];
    }
    grown = reached != before;
  }
}

/// What a block reaches in the one beside it along the axis, forward or backward.
BlockBits across(const BlockBits& reached, std::size_t axis, bool forward) {
  BlockBits result = {};
  for (std::size_t z = 0; z < result.size(); ++z) {
    if (axis == 0) result[z] = forward ? (reached[z] & kLastColumn) >> 7 : (reached[z] & kFirstColumn) << 7;
    if (axis == 1) result[z] = forward ? (reached[z] & kLastRow) >> 56 : (reached[z] & kFirstRow) << 56;
  }
  if (axis == 2) result[forward ? 0 : kBlockSide - 1] = reached[forward ? kBlockSide - 1 : 0];
  return result;
}

/// The voxels one further along the axis, forward or backward, at the place of those of the block. beyond: what lies
/// beyond the grid.
BlockBits shifted(const std::vector<BlockBits>& voxels, const VoxelGrid& grid, std::uint32_t index, std::size_t axis,
                  bool forward, std::uint64_t beyond) {
  BlockBits beside;
  beside.fill(beyond);
  auto position = grid.block_position(index);
  position[axis] += forward ? 1 : -1;
  if (position[axis] >= 0 && position[axis] < grid.blocks[axis])
    beside = voxels[grid.block_index(position[0], position[1], position[2])];
  BlockBits result = across(beside, axis, !forward);
  const BlockBits& block = voxels[index];
  for (std::size_t z = 0; z < result.size(); ++z) {
    if (axis == 0) result[z] |= forward ? block[z] >> 1 & ~kLastColumn : block[z] << 1 & ~kFirstColumn;
    if (axis == 1) result[z] |= forward ? block[z] >> kBlockSide : block[z] << kBlockSide;
    if (axis == 2 && forward && z + 1 < result.size()) result[z] = block[z + 1];
    if (axis == 2 && !forward && z > 0) result[z] = block[z - 1];
  }
  return result;
}

/// Takes away the voxels that have one without a bit among the 26 around.
void erode(std::vector<BlockBits>& voxels, const VoxelGrid& grid) {
  std::vector<BlockBits> result(voxels.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(voxels.size()), [&](std::uint32_t index) {
      const BlockBits before = shifted(voxels, grid, index, axis, false, kAllVoxels);
      const BlockBits after = shifted(voxels, grid, index, axis, true, kAllVoxels);
      for (std::size_t z = 0; z < before.size(); ++z) result[index][z] = voxels[index][z] & before[z] & after[z];
    });
    std::swap(voxels, result);
  }
}

/// Adds the 26 voxels around each.
void dilate(std::vector<BlockBits>& voxels, const VoxelGrid& grid) {
  std::vector<BlockBits> result(voxels.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(voxels.size()), [&](std::uint32_t index) {
      const BlockBits before = shifted(voxels, grid, index, axis, false, 0);
      const BlockBits after = shifted(voxels, grid, index, axis, true, 0);
      for (std::size_t z = 0; z < before.size(); ++z) result[index][z] = voxels[index][z] | before[z] | after[z];
    });
    std::swap(voxels, result);
  }
}

/// The voxels that are joined along the lattice to those at the border of the grid and near cameras.
std::vector<BlockBits> flood(const std::vector<BlockBits>& outside, const VoxelGrid& grid,
                             const std::vector<Eigen::Vector3d>& cameras) {
  std::vector<BlockBits> reached(outside.size());
  std::vector<std::uint32_t> waiting;  // blocks that were reached at a side
  std::vector<char> is_waiting(outside.size());
  const auto reach = [&](std::uint32_t index, const BlockBits& voxels) {
    bool grown = false;
    for (std::size_t z = 0; z < voxels.size(); ++z) {
      const std::uint64_t word = reached[index][z] | (voxels[z] & outside[index][z]);
      grown = grown || word != reached[index][z];
      reached[index][z] = word;
    }
    if (!grown || is_waiting[index] != 0) return;
    is_waiting[index] = 1;
    waiting.push_back(index);
  };
  for (std::uint32_t index = 0; index < outside.size(); ++index) reach(index, border_voxels(grid, index));
  BlockBits all;
  all.fill(kAllVoxels);
  for (const Eigen::Vector3d& camera : cameras) {
    const Eigen::Vector3d at = (camera - grid.origin) / (grid.voxel_size * kBlockSide);
    for (std::uint32_t beside = 0; beside < 27; ++beside) {
      const Eigen::Vector3d near =
          at + Eigen::Vector3d(beside % 3, beside / 3 % 3, beside / 9) - Eigen::Vector3d::Ones();
      if (!((near.array() >= 0.0).all() && near.x() < grid.blocks[0] && near.y() < grid.blocks[1] &&
            near.z() < grid.blocks[2]))
        continue;
      reach(grid.block_index(static_cast<int>(near.x()), static_cast<int>(near.y()), static_cast<int>(near.z())), all);
    }
  }
  while (!waiting.empty()) {
    const std::uint32_t index = waiting.back();
    waiting.pop_back();
    is_waiting[index] = 0;
    spread(reached[index], outside[index]);
    const auto position = grid.block_position(index);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool forward : {false, true}) {
        auto next = position;
        next[axis] += forward ? 1 : -1;
        if (next[axis] < 0 || next[axis] == grid.blocks[axis]) continue;
        reach(grid.block_index(next[0], next[1], next[2]), across(reached[index], axis, forward));
      }
    }
  }
  return reached;
}

}  // namespace

BlockBits border_voxels(const VoxelGrid& grid, std::uint32_t index) {
  const auto [x, y, z] = grid.block_position(index);
  BlockBits bits = {};
  const std::uint64_t sides = (x == 0 ? kFirstColumn : 0) | (x == grid.blocks[0] - 1 ? kLastColumn : 0) |
                              (y == 0 ? kFirstRow : 0) | (y == grid.blocks[1] - 1 ? kLastRow : 0);
  bits.fill(sides);
  if (z == 0) bits.front() = kAllVoxels;
  if (z == grid.blocks[2] - 1) bits.back() = kAllVoxels;
  return bits;
}

std::vector<BlockBits> find_free_space(const std::vector<BlockBits>& outside, const VoxelGrid& grid,
                                       const std::vector<Eigen::Vector3d>& cameras) {
  constexpr int kGrowth = 2;  // one step undoes the erosion, one more enters narrow gaps between surfaces
  std::vector<BlockBits> wide = outside;
  erode(wide, grid);
  std::vector<BlockBits> free = flood(wide, grid, cameras);
  wide = {};
  for (int step = 0; step < kGrowth; ++step) {
    dilate(free, grid);
    tbb::parallel_for(std::size_t{0}, free.size(), [&](std::size_t index) {
      for (std::size_t z = 0; z < free[index].size(); ++z) free[index][z] &= outside[index][z];
    });
  }
  return free;
}

}  // namespace quorum
