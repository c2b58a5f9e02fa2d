// The surface at signed distance zero in the voxel blocks (Lorensen and Cline 1987; the paper, section 2.2).
#pragma once

#include <utility>

#include "engine/mesh/mesh.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// Of each voxel of a block whether it was seen, and whether it lies inside (signed distance below zero). Cubes,
/// triangles and the numbers of vertices follow from these bits alone.
struct BlockSigns {
  BlockBits seen = {};
  BlockBits inside = {};
};

/// What is kept of the volume.
struct MeasuredSurface {
  VoxelGrid grid;
  std::vector<std::uint32_t> indices;     ///< of the blocks, ascending
  std::vector<BlockSigns> signs;          ///< of each block
  std::vector<std::size_t> first_vertex;  ///< of each block, in vertices
  std::vector<Vertex> vertices;           ///< of all edges between seen voxels of different sign
  std::vector<std::uint16_t> weights;     ///< of each voxel of each block, cut at the largest; only if asked for

  /// Takes what was kept of the blocks that follow.
  void append(const MeasuredSurface& next);
};

/// Triangles in every cube whose eight corners were all seen (weight above 0); what was not seen stays open. Vertices
/// are shared, also across blocks, and sorted by block, voxel and axis; triangles by block and voxel. Normals are means
/// of the triangles around, by area; color and confidence (accumulated weight) are interpolated along the edge.
/// Runs on all cores; the same bytes for any number of threads.
///
/// The volume may come in parts, so that it never lies in memory as a whole: where the sign changes between two seen
/// voxels, a vertex is made while they are there; of everything else, two bits a voxel are kept, and the weight if
/// asked for. The mesh is the same for any parts.
class MarchingCubes {
 public:
  /// keeps_weights: for a surface whose holes are filled.
  explicit MarchingCubes(const VoxelGrid& grid, bool keeps_weights = false) : keeps_weights_(keeps_weights) {
    surface_.grid = grid;
  }
  /// Goes on with what take() gave.
  explicit MarchingCubes(MeasuredSurface surface)
      : keeps_weights_(!surface.weights.empty()), surface_(std::move(surface)) {}

  /// Makes room for so many blocks, so that memory for what is kept of them is not taken twice.
  void reserve(std::size_t blocks);

  /// Takes the first count blocks of the pool, which follow those taken before. The pool also holds, of the stored
  /// blocks that lie one further along x, y or z, those that were not taken yet.
  void add(const BlockPool& pool, std::size_t count);

  /// Vertices so far; a few of them may be in no triangle and will be left out.
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return surface_.vertices; }

  /// The surface of all blocks that were added; the object is used up.
  Mesh finish();
  /// The same before triangles are made, for FilledSurface; the object is used up.
  MeasuredSurface take() { return std::move(surface_); }

 private:
  bool keeps_weights_;
  MeasuredSurface surface_;
};

/// The same for a volume that lies in memory.
Mesh marching_cubes(const BlockPool& pool, const VoxelGrid& grid);

}  // namespace quorum
