#include "engine/mesh/marching_cubes.h"

#include <oneapi/tbb/parallel_for.h>

#include <limits>
#include <span>

#include "engine/core/check.h"
#include "engine/mesh/block_cubes.h"

namespace quorum {
namespace {

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

  void weights(std::span<std::uint16_t> result) const {
    for (std::size_t local = 0; local < result.size(); ++local)
      result[local] = static_cast<std::uint16_t>(
          std::min(voxels_[local].weight, std::int32_t{std::numeric_limits<std::uint16_t>::max()}));
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

}  // namespace

void MeasuredSurface::append(const MeasuredSurface& next) {
  for (const std::size_t first : next.first_vertex) first_vertex.push_back(vertices.size() + first);
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(indices, next.indices);
  add(signs, next.signs);
  add(vertices, next.vertices);
  add(weights, next.weights);
}

void MarchingCubes::reserve(std::size_t blocks) {
  surface_.indices.reserve(blocks);
  surface_.signs.reserve(blocks);
  surface_.first_vertex.reserve(blocks);
  if (keeps_weights_) surface_.weights.reserve(blocks * kBlockVoxels);
}

void MarchingCubes::add(const BlockPool& pool, std::size_t count) {
  QUORUM_CHECK_LE(count, pool.indices.size());
  MeasuredSurface& s = surface_;
  const std::size_t first_block = s.indices.size();
  s.indices.insert(s.indices.end(), pool.indices.begin(), pool.indices.begin() + static_cast<std::ptrdiff_t>(count));
  s.signs.resize(s.indices.size());
  s.first_vertex.resize(s.indices.size());
  if (keeps_weights_) s.weights.resize(s.indices.size() * kBlockVoxels);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    const BlockVoxels block(pool, s.grid, slot);
    s.signs[first_block + slot] = block.signs();
    if (keeps_weights_) block.weights(std::span(s.weights).subspan((first_block + slot) * kBlockVoxels, kBlockVoxels));
    std::size_t crossings = 0;
    block.for_each_crossing([&](const Voxel&, const Voxel&, int, int, int, int) { ++crossings; });
    s.first_vertex[first_block + slot] = crossings;
  });
  std::size_t vertex_count = s.vertices.size();
  for (std::size_t block = first_block; block < s.indices.size(); ++block)
    vertex_count += std::exchange(s.first_vertex[block], vertex_count);
  s.vertices.resize(vertex_count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t slot) {
    const BlockVoxels block(pool, s.grid, slot);
    const auto [block_x, block_y, block_z] = block.origin();
    std::size_t next = s.first_vertex[first_block + slot];
    block.for_each_crossing([&](const Voxel& from, const Voxel& to, int x, int y, int z, int axis) {
      const Eigen::Vector3d position =
          s.grid.origin + s.grid.voxel_size * Eigen::Vector3d(block_x + x, block_y + y, block_z + z);
      s.vertices[next++] = make_vertex(from, to, position, s.grid.voxel_size, axis);
    });
  });
}

Mesh MarchingCubes::finish() {
  const MeasuredSurface& s = surface_;
  const auto neighborhood = [&s](std::size_t slot) {
    return Neighborhood(s.indices, s.grid, slot,
                        [&s](std::int64_t of, const std::array<int, 3>&, std::size_t word, int bit) {
                          if (of < 0) return VoxelState::kUnseen;
                          const BlockSigns& block = s.signs[static_cast<std::size_t>(of)];
                          if ((block.seen[word] >> bit & 1) == 0) return VoxelState::kUnseen;
                          return (block.inside[word] >> bit & 1) != 0 ? VoxelState::kInside : VoxelState::kOutside;
                        });
  };
  std::vector<BlockVertices> blocks(s.indices.size());
  std::vector<char> used(s.vertices.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    const std::size_t end = slot + 1 < blocks.size() ? s.first_vertex[slot + 1] : used.size();
    blocks[slot] =
        count_block(neighborhood(slot), std::span(used).subspan(s.first_vertex[slot], end - s.first_vertex[slot]));
  });
  const auto [vertex_count, triangle_count] = number_blocks(blocks);
  Mesh mesh;
  mesh.vertices = std::exchange(surface_.vertices, {});
  std::size_t kept = 0;
  for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
    if (used[vertex] != 0) mesh.vertices[kept++] = mesh.vertices[vertex];
  mesh.vertices.resize(kept);
  QUORUM_CHECK_EQ(mesh.vertices.size(), vertex_count);
  mesh.triangles.resize(triangle_count);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t slot) {
    if (blocks[slot].triangles > 0) write_triangles(neighborhood(slot), slot, blocks, mesh);
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
