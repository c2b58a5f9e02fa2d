#include "engine/mesh/marching_cubes.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <optional>

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

/// A block and the voxels around it, coordinates -1..8; null where no block is stored.
class Neighborhood {
 public:
  Neighborhood(const BlockPool& pool, const VoxelGrid& grid, std::size_t slot) : pool_(pool) {
    const auto [x, y, z] = grid.block_position(pool.indices[slot]);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) slots_[neighbor_index(dx, dy, dz)] = find(grid, x + dx, y + dy, z + dz);
    for (int vz = -1; vz <= kBlockSide; ++vz)
      for (int vy = -1; vy <= kBlockSide; ++vy)
        for (int vx = -1; vx <= kBlockSide; ++vx) voxels_[voxel_index(vx, vy, vz)] = load(vx, vy, vz);
  }

  /// The voxel at these coordinates if it was seen, else null.
  [[nodiscard]] const Voxel* seen(int x, int y, int z) const { return voxels_[voxel_index(x, y, z)]; }

  /// Inside flags of the cube that starts at these coordinates (-1..7), or nothing if a corner was not seen.
  [[nodiscard]] std::optional<int> cube_case(int x, int y, int z) const {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel* voxel = seen(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
      if (voxel == nullptr) return std::nullopt;
      if (voxel->distance < 0) inside |= 1 << corner;
    }
    return inside;
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
  [[nodiscard]] std::int64_t find(const VoxelGrid& grid, int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= grid.blocks[0] || y >= grid.blocks[1] || z >= grid.blocks[2]) return -1;
    const std::uint32_t index = grid.block_index(x, y, z);
    const auto found = std::lower_bound(pool_.indices.begin(), pool_.indices.end(), index);
    return found != pool_.indices.end() && *found == index ? found - pool_.indices.begin() : -1;
  }
  [[nodiscard]] const Voxel* load(int x, int y, int z) const {
    const std::int64_t slot = slots_[neighbor_index(x >> 3, y >> 3, z >> 3)];
    if (slot < 0) return nullptr;
    const int local = (x & 7) + kBlockSide * ((y & 7) + kBlockSide * (z & 7));
    const Voxel* voxel = pool_.voxels.data() + slot * kBlockVoxels + local;
    return voxel->weight > 0 ? voxel : nullptr;
  }

  const BlockPool& pool_;
  std::array<std::int64_t, 27> slots_ = {};
  std::array<const Voxel*, kSide * kSide * kSide> voxels_ = {};
};

template <typename Visit>
void for_each_voxel(Visit visit) {
  for (int z = 0; z < kBlockSide; ++z)
    for (int y = 0; y < kBlockSide; ++y)
      for (int x = 0; x < kBlockSide; ++x) visit(x, y, z, x + kBlockSide * (y + kBlockSide * z));
}

/// Which lattice edges of the block carry a vertex (one of the four cubes around is seen whole, and the sign changes),
/// and how many triangles its cubes make.
BlockVertices count_block(const Neighborhood& around) {
  BlockVertices result;
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
    const Voxel* from = around.seen(x, y, z);
    if (from == nullptr) return;
    for (int axis = 0; axis < 3; ++axis) {
      const Voxel* to = around.seen(x + (axis == 0), y + (axis == 1), z + (axis == 2));
      if (to == nullptr || (from->distance < 0) == (to->distance < 0)) continue;
      const int ax = axis == 0 ? 0 : 1;
      const int ay = axis == 1 ? 0 : 1;
      const int az = axis == 2 ? 0 : 1;
      bool used = false;
      for (int cube = 0; cube < 8; ++cube) {
        const int dx = cube & ax;
        const int dy = (cube >> 1) & ay;
        const int dz = (cube >> 2) & az;
        used = used || whole_at(x - dx, y - dy, z - dz);
      }
      const int edge = 3 * voxel + axis;
      if (used) result.bits[static_cast<std::size_t>(edge / 64)] |= 1ULL << (edge % 64);
    }
  });
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

void write_block(const Neighborhood& around, const VoxelGrid& grid, std::uint32_t block_index, std::size_t slot,
                 const std::vector<BlockVertices>& blocks, Mesh& mesh) {
  const auto block = grid.block_position(block_index);
  std::uint32_t next_vertex = blocks[slot].first;
  std::uint32_t next_triangle = blocks[slot].first_triangle;
  for_each_voxel([&](int x, int y, int z, int voxel) {
    for (int axis = 0; axis < 3; ++axis) {
      const int edge = 3 * voxel + axis;
      if ((blocks[slot].bits[static_cast<std::size_t>(edge / 64)] >> (edge % 64) & 1) == 0) continue;
      const Eigen::Vector3d position =
          grid.origin + grid.voxel_size * Eigen::Vector3d(block[0] * kBlockSide + x, block[1] * kBlockSide + y,
                                                          block[2] * kBlockSide + z);
      mesh.vertices[next_vertex++] =
          make_vertex(*around.seen(x, y, z), *around.seen(x + (axis == 0), y + (axis == 1), z + (axis == 2)), position,
                      grid.voxel_size, axis);
    }
  });
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

Mesh marching_cubes(const BlockPool& pool, const VoxelGrid& grid) {
  std::vector<BlockVertices> blocks(pool.indices.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(),
                    [&](std::size_t slot) { blocks[slot] = count_block(Neighborhood(pool, grid, slot)); });
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;
  for (BlockVertices& block : blocks) {
    block.first = vertex_count;
    block.first_triangle = triangle_count;
    vertex_count += block.count();
    triangle_count += block.triangles;
  }
  Mesh mesh;
  mesh.vertices.resize(vertex_count);
  mesh.triangles.resize(triangle_count);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    if (blocks[slot].triangles > 0 || blocks[slot].count() > 0)
      write_block(Neighborhood(pool, grid, slot), grid, pool.indices[slot], slot, blocks, mesh);
  });
  add_normals(mesh);
  return mesh;
}

}  // namespace quorum
