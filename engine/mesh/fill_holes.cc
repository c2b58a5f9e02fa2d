#include "engine/mesh/fill_holes.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/check.h"
#include "engine/mesh/block_cubes.h"
#include "engine/mesh/filled_patches.h"
#include "engine/mesh/free_space.h"
#include "engine/mesh/make_manifold.h"

namespace quorum {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};
constexpr double kLargestHole = 0.01;  // share of the measured vertices, where no background is known: docs/quality.md

/// Whether the voxels of a block, which was seen, are outside. empty: its voxels.
BlockBits classify(const BlockSigns& signs, const std::uint16_t* weights, int least_weight, const BlockBits& empty) {
  BlockBits outside;
  for (std::size_t z = 0; z < outside.size(); ++z) {
    std::uint64_t confident = 0;
    for (int bit = 0; bit < 64; ++bit)
      confident |= static_cast<std::uint64_t>(weights[z * 64 + static_cast<std::size_t>(bit)] >= least_weight) << bit;
    const std::uint64_t positive = signs.seen[z] & ~signs.inside[z];
    outside[z] = positive | (empty[z] & ~(signs.seen[z] & confident));
  }
  return outside;
}

/// True if the voxels of the block, and those one further along x, y and z, are all outside or all inside.
bool is_uniform(const std::vector<BlockBits>& outside, const VoxelGrid& grid, std::uint32_t index) {
  const BlockBits& block = outside[index];
  const std::uint64_t value = (block[0] & 1) != 0 ? kAll : 0;
  if (std::ranges::any_of(block, [&](std::uint64_t word) { return word != value; })) return false;
  const auto [x, y, z] = grid.block_position(index);
  for (int next = 1; next < 8; ++next) {
    const int dx = next & 1;
    const int dy = next >> 1 & 1;
    const int dz = next >> 2;
    if (x + dx >= grid.blocks[0] || y + dy >= grid.blocks[1] || z + dz >= grid.blocks[2]) continue;
    const std::uint64_t mask = (dx != 0 ? 0x0101010101010101ULL : kAll) & (dy != 0 ? 0xffULL : kAll);
    const BlockBits& beside = outside[grid.block_index(x + dx, y + dy, z + dz)];
    for (std::size_t word = 0; word < (dz != 0 ? 1U : beside.size()); ++word)
      if (((beside[word] ^ value) & mask) != 0) return false;
  }
  return true;
}

/// How many edges of different sign start in the block.
std::size_t count_crossings(const std::vector<BlockBits>& outside, const VoxelGrid& grid, std::uint32_t index) {
  constexpr std::uint64_t kFirstColumn = 0x0101010101010101ULL;
  constexpr std::uint64_t kFirstRow = 0xffULL;
  const BlockBits& block = outside[index];
  const auto at = grid.block_position(index);
  const auto next = [&](std::size_t axis) -> const BlockBits* {
    auto position = at;
    if (++position[axis] == grid.blocks[axis]) return nullptr;
    return &outside[grid.block_index(position[0], position[1], position[2])];
  };
  const BlockBits* next_x = next(0);
  const BlockBits* next_y = next(1);
  const BlockBits* next_z = next(2);
  int count = 0;
  for (std::size_t z = 0; z < block.size(); ++z) {
    const std::uint64_t word = block[z];
    count += std::popcount((word ^ word >> 1) & ~(kFirstColumn << 7));
    count += std::popcount((word ^ word >> kBlockSide) & ~(kFirstRow << 56));
    if (next_x != nullptr) count += std::popcount((word >> 7 ^ (*next_x)[z]) & kFirstColumn);
    if (next_y != nullptr) count += std::popcount((word >> 56 ^ (*next_y)[z]) & kFirstRow);
    if (z + 1 < block.size())
      count += std::popcount(word ^ block[z + 1]);
    else if (next_z != nullptr)
      count += std::popcount(word ^ (*next_z)[0]);
  }
  return static_cast<std::size_t>(count);
}

/// Vertices on all edges of different sign that start in the block, and how many triangles its cubes make.
BlockVertices count_block(const Neighborhood& around) {
  BlockVertices result;
  for_each_voxel([&](int x, int y, int z, int voxel) {
    if (const auto cube = around.cube_case(x, y, z))
      result.triangles += static_cast<std::uint32_t>(case_table()[static_cast<std::size_t>(*cube)].size());
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<int, 3> next = {x + (axis == 0), y + (axis == 1), z + (axis == 2)};
      if (!around.seen(next[0], next[1], next[2]) || around.inside(x, y, z) == around.inside(next[0], next[1], next[2]))
        continue;
      const int edge = 3 * voxel + axis;
      result.bits[static_cast<std::size_t>(edge / 64)] |= 1ULL << (edge % 64);
    }
  });
  return result;
}

/// The voxels at the border of the grid count as outside, too.
void add_border(std::vector<BlockBits>& outside, const VoxelGrid& grid) {
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(outside.size()), [&](std::uint32_t index) {
    const BlockBits border = border_voxels(grid, index);
    for (std::size_t z = 0; z < border.size(); ++z) outside[index][z] |= border[z];
  });
}

/// Walks along the edges of a block in their order and finds the measured vertices.
class MeasuredEdges {
 public:
  MeasuredEdges(const MeasuredSurface& surface, std::uint32_t index) : surface_(surface) {
    const auto [x, y, z] = surface.grid.block_position(index);
    slots_[0] = find_block(surface.indices, surface.grid, x, y, z);
    for (int axis = 0; axis < 3; ++axis)
      slots_[1 + axis] = find_block(surface.indices, surface.grid, x + (axis == 0), y + (axis == 1), z + (axis == 2));
    if (slots_[0] >= 0) next_ = surface.first_vertex[static_cast<std::size_t>(slots_[0])];
  }

  /// The vertex of the next edge, if there is one. To be called for each voxel and axis of the block, in order.
  const Vertex* next(int x, int y, int z, int axis) {
    const std::array<int, 3> to = {x + (axis == 0), y + (axis == 1), z + (axis == 2)};
    const bool last = to[static_cast<std::size_t>(axis)] == kBlockSide;
    const BlockSigns* from_block = signs(0);
    const BlockSigns* to_block = last ? signs(1 + axis) : from_block;
    if (from_block == nullptr || to_block == nullptr) return nullptr;
    if (!has(from_block->seen, x, y, z) || !has(to_block->seen, to[0] & 7, to[1] & 7, to[2] & 7)) return nullptr;
    if (has(from_block->inside, x, y, z) == has(to_block->inside, to[0] & 7, to[1] & 7, to[2] & 7)) return nullptr;
    return &surface_.vertices[next_++];
  }

  /// Whether a voxel of the block was measured to be inside. For a block with a vertex.
  [[nodiscard]] bool inside(int x, int y, int z) const { return has(signs(0)->inside, x, y, z); }

 private:
  static bool has(const BlockBits& bits, int x, int y, int z) {
    return (bits[static_cast<std::size_t>(z)] >> (x + kBlockSide * y) & 1) != 0;
  }
  [[nodiscard]] const BlockSigns* signs(int which) const {
    const std::int64_t slot = slots_[static_cast<std::size_t>(which)];
    return slot < 0 ? nullptr : &surface_.signs[static_cast<std::size_t>(slot)];
  }

  const MeasuredSurface& surface_;
  std::array<std::int64_t, 4> slots_ = {};  // of the block, and of those one further along x, y and z
  std::size_t next_ = 0;
};

}  // namespace

FilledSurface::FilledSurface(MeasuredSurface measured, EmptySpace empty, float min_confidence)
    : measured_(std::move(measured)),
      outside_(std::move(empty.voxels)),
      min_confidence_(min_confidence),
      knows_background_(empty.beyond_grid) {
  const VoxelGrid& grid = measured_.grid;
  QUORUM_CHECK_EQ(outside_.size(), grid.block_count());
  QUORUM_CHECK_EQ(measured_.weights.size(), measured_.indices.size() * kBlockVoxels);
  const double least = std::ceil(static_cast<double>(min_confidence) * kWeightScale);
  const int least_weight = static_cast<int>(std::clamp(least, 1.0, 65536.0));
  tbb::parallel_for(std::size_t{0}, measured_.indices.size(), [&](std::size_t slot) {
    BlockBits& bits = outside_[measured_.indices[slot]];
    bits = classify(measured_.signs[slot], measured_.weights.data() + slot * kBlockVoxels, least_weight, bits);
  });
  measured_.weights = {};
  if (empty.beyond_grid) add_border(outside_, grid);
  outside_ = find_free_space(outside_, grid, empty.cameras);
  if (empty.beyond_grid) add_border(outside_, grid);
  tbb::parallel_for(std::size_t{0}, measured_.indices.size(), [&](std::size_t slot) {
    BlockBits& bits = outside_[measured_.indices[slot]];
    const BlockSigns& signs = measured_.signs[slot];
    for (std::size_t z = 0; z < bits.size(); ++z) bits[z] |= signs.seen[z] & ~signs.inside[z];
  });
  std::vector<char> active(outside_.size());
  tbb::parallel_for(std::size_t{0}, active.size(), [&](std::size_t index) {
    active[index] = is_uniform(outside_, grid, static_cast<std::uint32_t>(index)) ? 0 : 1;
  });
  for (std::uint32_t index = 0; index < active.size(); ++index)
    if (active[index] != 0) active_.push_back(index);
  for (const std::uint32_t index : active_) vertex_count_ += count_crossings(outside_, grid, index);
}

Mesh FilledSurface::extract() {
  const VoxelGrid& grid = measured_.grid;
  const auto neighborhood = [&](std::size_t slot) {
    return Neighborhood(active_, grid, slot,
                        [&](std::int64_t, const std::array<int, 3>& block, std::size_t word, int bit) {
                          for (std::size_t axis = 0; axis < 3; ++axis)
                            if (block[axis] < 0 || block[axis] >= grid.blocks[axis]) return VoxelState::kUnseen;
                          const BlockBits& bits = outside_[grid.block_index(block[0], block[1], block[2])];
                          return (bits[word] >> bit & 1) != 0 ? VoxelState::kOutside : VoxelState::kInside;
                        });
  };
  std::vector<BlockVertices> blocks(active_.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(),
                    [&](std::size_t slot) { blocks[slot] = count_block(neighborhood(slot)); });
  const MeshSize size = number_blocks(blocks);
  QUORUM_CHECK_EQ(std::size_t{size.vertices}, vertex_count_);
  Mesh mesh;
  mesh.vertices.resize(size.vertices);
  mesh.triangles.resize(size.triangles);
  std::vector<char> at_border(size.vertices);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    const Neighborhood around = neighborhood(slot);
    MeasuredEdges measured(measured_, active_[slot]);
    const auto position = grid.block_position(active_[slot]);
    std::uint32_t next = blocks[slot].first;
    for_each_voxel([&](int x, int y, int z, int voxel) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vertex* found = measured.next(x, y, z, axis);
        const int edge = 3 * voxel + axis;
        if ((blocks[slot].bits[static_cast<std::size_t>(edge / 64)] >> (edge % 64) & 1) == 0) continue;
        const std::array<int, 3> place = {position[0] * kBlockSide + x, position[1] * kBlockSide + y,
                                          position[2] * kBlockSide + z};
        const bool same_way = found != nullptr && measured.inside(x, y, z) == around.inside(x, y, z);
        if (same_way && found->confidence >= min_confidence_) {
          mesh.vertices[next] = *found;
        } else {
          Eigen::Vector3d at(place[0], place[1], place[2]);
          at(axis) += 0.5;
          mesh.vertices[next].position = (grid.origin + grid.voxel_size * at).cast<float>();
        }
        for (int across = 0; across < 3; ++across) {
          const auto k = static_cast<std::size_t>(across);
          if (across != axis && (place[k] == 0 || place[k] == grid.blocks[k] * kBlockSide - 1)) at_border[next] = 1;
        }
        ++next;
      }
    });
    if (blocks[slot].triangles > 0) write_triangles(around, slot, blocks, mesh);
  });
  measured_ = {};
  outside_ = {};
  drop_unbounded(mesh, at_border, knows_background_ ? std::numeric_limits<double>::infinity() : kLargestHole);
  drop_unused_vertices(mesh);
  mesh.vertices.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  return mesh;
}

Mesh FilledSurface::finish() {
  Mesh mesh = extract();
  settle_filled(mesh);
  return mesh;
}

}  // namespace quorum
