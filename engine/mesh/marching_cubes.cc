#include "engine/mesh/marching_cubes.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/mesh/case_table.h"

namespace quorum {
namespace {

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
std::int64_t find_block(const std::vector<std::uint32_t>& indices, const VoxelGrid& grid, int x, int y, int z) {
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

/// The voxels of a block, and those one further along each axis, in the blocks that lie there.
class BlockVoxels {
 public:
  BlockVoxels(const BlockPool& pool, const VoxelGrid& grid, std::size_t slot)
      : block_(grid.block_position(pool.indices[slot])), voxels_(voxels_of(pool, static_cast<std::int64_t>(slot))) {
    for (int axis = 0; axis < 3; ++axis)
      next_[axis] = voxels_of(pool, find_block(pool.indices, grid, block_[0] + (axis == 0), block_[1] + (axis == 1),
                                               block_[2] + (axis == 2)));
  }

  /// Calls visit(voxel, next voxel, x, y, z, axis) for the edges between seen voxels of different sign, in the order of
  /// voxel and axis.
  template <typename Visit>
  void for_each_crossing(Visit visit) const {
    for_each_voxel([&](int x, int y, int z, int local) {
      const Voxel& from = voxels_[local];
      if (from.weight <= 0) return;
      const std::array<int, 3> at = {x, y, z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::array<int, 3> kStep = {1, kBlockSide, kBlockSide * kBlockSide};
        const bool last = at[axis] == kBlockSide - 1;
        const Voxel* block = last ? next_[axis] : voxels_;
        if (block == nullptr) continue;
        const Voxel& to = block[local + (last ? -(kBlockSide - 1) : 1) * kStep[axis]];
        if (to.weight > 0 && (from.distance < 0) != (to.distance < 0)) visit(from, to, x, y, z, static_cast<int>(axis));
      }
    });
  }

  [[nodiscard]] BlockSigns signs() const {
    BlockSigns result;
    for_each_voxel([&](int x, int y, int z, int local) {
      const std::uint64_t bit = 1ULL << (x + kBlockSide * y);
      if (voxels_[local].weight > 0) result.seen[static_cast<std::size_t>(z)] |= bit;
      if (voxels_[local].distance < 0) result.inside[static_cast<std::size_t>(z)] |= bit;
    });
    return result;
  }

  /// Coordinates of the block's first voxel in the lattice.
  [[nodiscard]] std::array<int, 3> origin() const {
    return {block_[0] * kBlockSide, block_[1] * kBlockSide, block_[2] * kBlockSide};
  }

 private:
  static const Voxel* voxels_of(const BlockPool& pool, std::int64_t slot) {
    return slot < 0 ? nullptr : pool.voxels.data() + slot * kBlockVoxels;
  }

  std::array<int, 3> block_;
  const Voxel* voxels_;
  const Voxel* next_[3];
};

/// What is known of a block and the voxels around it, coordinates -1..8.
class Neighborhood {
 public:
  Neighborhood(const std::vector<std::uint32_t>& indices, const std::vector<BlockSigns>& signs, const VoxelGrid& grid,
               std::size_t slot) {
    const auto [x, y, z] = grid.block_position(indices[slot]);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          slots_[neighbor_index(dx, dy, dz)] = find_block(indices, grid, x + dx, y + dy, z + dz);
    for (int vz = -1; vz <= kBlockSide; ++vz)
      for (int vy = -1; vy <= kBlockSide; ++vy)
        for (int vx = -1; vx <= kBlockSide; ++vx) voxels_[voxel_index(vx, vy, vz)] = load(signs, vx, vy, vz);
  }

  [[nodiscard]] bool seen(int x, int y, int z) const { return voxels_[voxel_index(x, y, z)] != kUnseen; }
  /// False if it was not seen.
  [[nodiscard]] bool inside(int x, int y, int z) const { return voxels_[voxel_index(x, y, z)] == kInside; }

  /// Inside flags of the cube that starts at these coordinates (-1..7), or nothing if a corner was not seen.
  [[nodiscard]] std::optional<int> cube_case(int x, int y, int z) const {
    int corners = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const State state = voxels_[voxel_index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))];
      if (state == kUnseen) return std::nullopt;
      if (state == kInside) corners |= 1 << corner;
    }
    return corners;
  }

  /// Slot of the block that holds these coordinates.
  [[nodiscard]] std::size_t slot_of(int x, int y, int z) const {
    return static_cast<std::size_t>(slots_[neighbor_index(x >> 3, y >> 3, z >> 3)]);
  }

 private:
  enum State : std::uint8_t { kUnseen, kOutside, kInside };

  static std::size_t neighbor_index(int dx, int dy, int dz) {
    return static_cast<std::size_t>(dx + 1 + 3 * (dy + 1 + 3 * (dz + 1)));
  }
  static std::size_t voxel_index(int x, int y, int z) {
    return static_cast<std::size_t>(x + 1 + kSide * (y + 1 + kSide * (z + 1)));
  }
  [[nodiscard]] State load(const std::vector<BlockSigns>& signs, int x, int y, int z) const {
    const std::int64_t slot = slots_[neighbor_index(x >> 3, y >> 3, z >> 3)];
    if (slot < 0) return kUnseen;
    const BlockSigns& block = signs[static_cast<std::size_t>(slot)];
    const auto word = static_cast<std::size_t>(z & 7);
    const int bit = (x & 7) + kBlockSide * (y & 7);
    if ((block.seen[word] >> bit & 1) == 0) return kUnseen;
    return (block.inside[word] >> bit & 1) != 0 ? kInside : kOutside;
  }

  std::array<std::int64_t, 27> slots_ = {};
  std::array<State, kSide* kSide* kSide> voxels_ = {};
};

/// Which lattice edges of the block carry a vertex (one of the four cubes around is seen whole, and the sign changes),
/// and how many triangles its cubes make. used: one flag for each vertex that MarchingCubes made in the
/// block.
BlockVertices count_block(const Neighborhood& around, std::span<char> used) {
  BlockVertices result;
  std::size_t made = 0;
  std::array<bool, 9 * 9 * 9> whole;
  const auto whole_at = [&](int x, int y, int z) -> bool& {
    return whole[static_cast<std::size_t>(x + 1 + 9 * (y + 1 + 9 * (z + 1)))];
  };
  for (int z = -1; z < kBlockSide; ++z) {
    for (int y = -1; y < kBlockSide; ++y) {
      for (int x = -1; x < kBlockSide; ++x) {
        const auto cube = around.cube_case(x, y, z);
        whole_at(x, y, z) = cube.has_value();
        if (cube && x >= 0 && y >= 0 && z >= 0)
          result.triangles += static_cast<std::uint32_t>(case_table()[static_cast<std::size_t>(*cube)].size());
      }
    }
  }
  for_each_voxel([&](int x, int y, int z, int voxel) {
    if (!around.seen(x, y, z)) return;
    for (int axis = 0; axis < 3; ++axis) {
      const int ax = axis == 0 ? 1 : 0;
      const int ay = axis == 1 ? 1 : 0;
      const int az = axis == 2 ? 1 : 0;
      if (!around.seen(x + ax, y + ay, z + az) || around.inside(x, y, z) == around.inside(x + ax, y + ay, z + az))
        continue;
      bool in_cube = false;
      for (int cube = 0; cube < 8; ++cube) {
        const int dx = cube & 1 & ~ax;
        const int dy = cube >> 1 & 1 & ~ay;
        const int dz = cube >> 2 & 1 & ~az;
        in_cube = in_cube || whole_at(x - dx, y - dy, z - dz);
      }
      const int edge = 3 * voxel + axis;
      if (in_cube) result.bits[static_cast<std::size_t>(edge / 64)] |= 1ULL << (edge % 64);
      QUORUM_CHECK_LT(made, used.size());
      used[made++] = in_cube ? 1 : 0;
    }
  });
  QUORUM_CHECK_EQ(made, used.size());
  return result;
}

/// The vertex between two voxels of different sign.
Vertex make_vertex(const Voxel& from, const Voxel& to, const Eigen::Vector3d& position, double step, int axis) {
  const double from_distance = static_cast<double>(from.distance) / from.weight;
  const double to_distance = static_cast<double>(to.distance) / to.weight;
  const double t = from_distance / (from_distance - to_distance);
  Vertex vertex;
  Eigen::Vector3d at = position;
  at(axis) += t * step;
  vertex.position = at.cast<float>();
  vertex.confidence = static_cast<float>(((1.0 - t) * from.weight + t * to.weight) / kWeightScale);
  const auto channel = [&](int index) {
    const double a = static_cast<double>(from.color[index]) / from.weight;
    const double b = static_cast<double>(to.color[index]) / to.weight;
    return static_cast<std::uint32_t>(std::clamp((1.0 - t) * a + t * b + 0.5, 0.0, 255.0));
  };
  vertex.color = make_rgb(channel(0), channel(1), channel(2));
  return vertex;
}

void write_triangles(const Neighborhood& around, std::size_t slot, const std::vector<BlockVertices>& blocks,
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
void add_normals(Mesh& mesh) {
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

}  // namespace

void MarchingCubes::add(const BlockPool& pool, std::size_t count) {
  QUORUM_CHECK_LE(count, pool.indices.size());
  if (count == 0) return;
  if (!indices_.empty()) QUORUM_CHECK_LT(indices_.back(), pool.indices.front());
  const std::size_t first_block = indices_.size();
  indices_.insert(indices_.end(), pool.indices.begin(), pool.indices.begin() + static_cast<std::ptrdiff_t>(count));
  signs_.resize(indices_.size());
  first_vertex_.resize(indices_.size());
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    const BlockVoxels block(pool, grid_, slot);
    signs_[first_block + slot] = block.signs();
    std::size_t crossings = 0;
    block.for_each_crossing([&](const Voxel&, const Voxel&, int, int, int, int) { ++crossings; });
    first_vertex_[first_block + slot] = crossings;
  });
  std::size_t vertex_count = vertices_.size();
  for (std::size_t block = first_block; block < indices_.size(); ++block)
    vertex_count += std::exchange(first_vertex_[block], vertex_count);
  vertices_.resize(vertex_count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    const BlockVoxels block(pool, grid_, slot);
    const auto [block_x, block_y, block_z] = block.origin();
    std::size_t next = first_vertex_[first_block + slot];
    block.for_each_crossing([&](const Voxel& from, const Voxel& to, int x, int y, int z, int axis) {
      const Eigen::Vector3d position =
          grid_.origin + grid_.voxel_size * Eigen::Vector3d(block_x + x, block_y + y, block_z + z);
      vertices_[next++] = make_vertex(from, to, position, grid_.voxel_size, axis);
    });
  });
}

Mesh MarchingCubes::finish() {
  std::vector<BlockVertices> blocks(indices_.size());
  std::vector<char> used(vertices_.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    const std::size_t end = slot + 1 < blocks.size() ? first_vertex_[slot + 1] : used.size();
    blocks[slot] = count_block(Neighborhood(indices_, signs_, grid_, slot),
                               std::span(used).subspan(first_vertex_[slot], end - first_vertex_[slot]));
  });
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;
  for (BlockVertices& block : blocks) {
    block.first = vertex_count;
    block.first_triangle = triangle_count;
    vertex_count += block.count();
    triangle_count += block.triangles;
  }
  Mesh mesh;
  mesh.vertices = std::exchange(vertices_, {});
  std::size_t kept = 0;
  for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
    if (used[vertex] != 0) mesh.vertices[kept++] = mesh.vertices[vertex];
  mesh.vertices.resize(kept);
  QUORUM_CHECK_EQ(mesh.vertices.size(), vertex_count);
  mesh.triangles.resize(triangle_count);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    if (blocks[slot].triangles > 0) write_triangles(Neighborhood(indices_, signs_, grid_, slot), slot, blocks, mesh);
  });
  add_normals(mesh);
  return mesh;
}

Mesh marching_cubes(const BlockPool& pool, const VoxelGrid& grid) {
  MarchingCubes cubes(grid);
  cubes.add(pool, pool.indices.size());
  return cubes.finish();
}

}  // namespace quorum
