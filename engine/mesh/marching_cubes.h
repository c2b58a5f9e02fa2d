// The surface at signed distance zero in the voxel blocks (Lorensen and Cline 1987; the paper, section 2.2).
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// Of each voxel of a block whether it was seen, and whether it lies inside (signed distance below zero). Bit x + 8 y
/// of word z. Cubes, triangles and the numbers of vertices follow from these bits alone.
struct BlockSigns {
  std::array<std::uint64_t, kBlockSide> seen = {};
  std::array<std::uint64_t, kBlockSide> inside = {};
};

/// Triangles in every cube whose eight corners were all seen (weight above 0); what was not seen stays open. Vertices
/// are shared, also across blocks, and sorted by block, voxel and axis; triangles by block and voxel. Normals are means
/// of the triangles around, by area; color and confidence (accumulated weight) are interpolated along the edge.
/// Runs on all cores; the same bytes for any number of threads.
///
/// The volume may come in parts, so that it never lies in memory as a whole: where the sign changes between two seen
/// voxels, a vertex is made while they are there; of everything else, two bits a voxel are kept. The mesh is the same
/// for any parts.
class MarchingCubes {
 public:
  explicit MarchingCubes(const VoxelGrid& grid) : grid_(grid) {}

  /// Takes the first count blocks of the pool, which follow those taken before. The pool also holds, of the stored
  /// blocks that lie one further along x, y or z, those that were not taken yet.
  void add(const BlockPool& pool, std::size_t count);

  /// Vertices so far; a few of them may be in no triangle and will be left out.
  [[nodiscard]] std::size_t vertex_count() const { return vertices_.size(); }

  /// The surface of all blocks that were added; the object is used up.
  Mesh finish();

 private:
  VoxelGrid grid_;
  std::vector<std::uint32_t> indices_;     // of the blocks, ascending
  std::vector<BlockSigns> signs_;          // of each block
  std::vector<std::size_t> first_vertex_;  // of each block, in vertices_
  std::vector<Vertex> vertices_;           // of all edges between seen voxels of different sign
};

/// The same for a volume that lies in memory.
Mesh marching_cubes(const BlockPool& pool, const VoxelGrid& grid);

}  // namespace quorum
