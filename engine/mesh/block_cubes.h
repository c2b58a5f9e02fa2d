// Cubes block by block: what the surfaces that marching_cubes extracts, with and without filled holes, have in common.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <vector>

#include "engine/mesh/case_table.h"
#include "engine/mesh/mesh.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

constexpr int kSide = kBlockSide + 2;  // a block with one voxel more on each side
constexpr int kEdgesOfBlock = 3 * kBlockVoxels;

/// Vertices of a block: one bit for each lattice edge (3 * voxel + axis) that starts in it, and the number of the
/// first.
struct BlockVertices {
  std::array<std::uint64_t, kEdgesOfBlock / 64> bits = {};
  std::uint32_t first = 0;
  std::uint32_t first_triangle = 0;
  std::uint32_t triangles = 0;

  [[nodiscard]] std::uint32_t count() const {
    std::uint32_t total = 0;
    for (const std::uint64_t word : bits) total += static_cast<std::uint32_t>(std::popcount(word));
    return total;
  }
  [[nodiscard]] std::uint32_t number(int edge) const {
    const auto word = static_cast<std::size_t>(edge / 64);
    std::uint32_t rank = first;
    for (std::size_t before = 0; before < word; ++before)
      rank += static_cast<std::uint32_t>(std::popcount(bits[before]));
    return rank + static_cast<std::uint32_t>(std::popcount(bits[word] & ((1ULL << (edge % 64)) - 1)));
  }
};

/// Place of a block in the ascending list, or -1 if it is not stored.
inline std::int64_t find_block(const std::vector<std::uint32_t>& indices, const VoxelGrid& grid, int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0 || x >= grid.blocks[0] || y >= grid.blocks[1] || z >= grid.blocks[2]) return -1;
  const std::uint32_t index = grid.block_index(x, y, z);
  const auto found = std::lower_bound(indices.begin(), indices.end(), index);
  return found != indices.end() && *found == index ? found - indices.begin() : -1;
}

template <typename Visit>
void for_each_voxel(Visit visit) {
  for (int z = 0; z < kBlockSide; ++z)
    for (int y = 0; y < kBlockSide; ++y)
      for (int x = 0; x < kBlockSide; ++x) visit(x, y, z, x + kBlockSide * (y + kBlockSide * z));
}

enum class VoxelState : std::uint8_t { kUnseen, kOutside, kInside };

/// What is known of a block and the voxels around it, coordinates -1..8.
class Neighborhood {
 public:
  /// state_of(slot, block, word, bit): of a voxel of the block at these coordinates, which is the slot-th, or has slot
  /// -1 if it is not in the list.
  template <typename StateOf>
  Neighborhood(const std::vector<std::uint32_t>& indices, const VoxelGrid& grid, std::size_t slot,
               const StateOf& state_of) {
    const auto [x, y, z] = grid.block_position(indices[slot]);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          slots_[neighbor_index(dx, dy, dz)] = find_block(indices, grid, x + dx, y + dy, z + dz);
    for (int vz = -1; vz <= kBlockSide; ++vz)
      for (int vy = -1; vy <= kBlockSide; ++vy)
        for (int vx = -1; vx <= kBlockSide; ++vx)
          voxels_[voxel_index(vx, vy, vz)] =
              state_of(slots_[neighbor_index(vx >> 3, vy >> 3, vz >> 3)],
                       std::array<int, 3>{x + (vx >> 3), y + (vy >> 3), z + (vz >> 3)},
                       static_cast<std::size_t>(vz & 7), (vx & 7) + kBlockSide * (vy & 7));
  }

  [[nodiscard]] bool seen(int x, int y, int z) const { return voxels_[voxel_index(x, y, z)] != VoxelState::kUnseen; }
  /// False if it was not seen.
  [[nodiscard]] bool inside(int x, int y, int z) const { return voxels_[voxel_index(x, y, z)] == VoxelState::kInside; }

  /// Inside flags of the cube that starts at these coordinates (-1..7), or nothing if a corner was not seen.
  [[nodiscard]] std::optional<int> cube_case(int x, int y, int z) const {
    int corners = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const VoxelState state = voxels_[voxel_index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))];
      if (state == VoxelState::kUnseen) return std::nullopt;
      if (state == VoxelState::kInside) corners |= 1 << corner;
    }
    return corners;
  }

  /// Slot of the block that holds these coordinates.
  [[nodiscard]] std::size_t slot_of(int x, int y, int z) const {
    return static_cast<std::size_t>(slots_[neighbor_index(x >> 3, y >> 3, z >> 3)]);
  }

 private:
  static std::size_t neighbor_index(int dx, int dy, int dz) {
    return static_cast<std::size_t>(dx + 1 + 3 * (dy + 1 + 3 * (dz + 1)));
  }
  static std::size_t voxel_index(int x, int y, int z) {
    return static_cast<std::size_t>(x + 1 + kSide * (y + 1 + kSide * (z + 1)));
  }
  std::array<std::int64_t, 27> slots_ = {};
  std::array<VoxelState, kSide* kSide* kSide> voxels_ = {};
};

struct MeshSize {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
};

/// Gives each block the numbers of its first vertex and triangle.
inline MeshSize number_blocks(std::vector<BlockVertices>& blocks) {
  MeshSize size;
  for (BlockVertices& block : blocks) {
    block.first = size.vertices;
    block.first_triangle = size.triangles;
    size.vertices += block.count();
    size.triangles += block.triangles;
  }
  return size;
}

/// The triangles of the cubes that start in a block, into their place in the mesh.
inline void write_triangles(const Neighborhood& around, std::size_t slot, const std::vector<BlockVertices>& blocks,
                            Mesh& mesh) {
  std::uint32_t next_triangle = blocks[slot].first_triangle;
  for_each_voxel([&](int x, int y, int z, int) {
    const auto cube = around.cube_case(x, y, z);
    if (!cube) return;
    for (const auto& triangle : case_table()[static_cast<std::size_t>(*cube)]) {
      std::array<std::uint32_t, 3> corners;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const CubeEdge& edge = cube_edges()[triangle[corner]];
        const int ex = x + (edge.corner & 1);
        const int ey = y + (edge.corner >> 1 & 1);
        const int ez = z + (edge.corner >> 2);
        const int local = (ex & 7) + kBlockSide * ((ey & 7) + kBlockSide * (ez & 7));
        corners[corner] = blocks[around.slot_of(ex, ey, ez)].number(3 * local + edge.axis);
      }
      mesh.triangles[next_triangle++] = corners;
    }
  });
}

/// Normals as area-weighted means over the triangles around each vertex, added in the order of the triangles.
inline void add_normals(Mesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  const auto position = [&](std::uint32_t vertex) -> Eigen::Vector3d {
    return mesh.vertices[vertex].position.cast<double>();
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d normal = (position(b) - position(a)).cross(position(c) - position(a));
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += normal;
  }
  for (std::size_t vertex = 0; vertex < normals.size(); ++vertex) {
    const double length = normals[vertex].norm();
    if (length > 0) mesh.vertices[vertex].normal = (normals[vertex] / length).cast<float>();
  }
}

}  // namespace quorum
