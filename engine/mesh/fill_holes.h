// The surface with its holes filled by space carving (B. Curless and M. Levoy, A Volumetric Method for Building Complex
// Models from Range Images, SIGGRAPH 1996, section 4): where no surface was measured, it lies between what views looked
// through and what no view saw.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/mesh/marching_cubes.h"

namespace quorum {

/// What views looked through.
struct EmptySpace {
  std::vector<BlockBits> voxels;         ///< of all blocks of the grid
  bool beyond_grid = false;              ///< nothing is beyond the grid either: most views show a background
  std::vector<Eigen::Vector3d> cameras;  ///< their centers, in the world
};

/// Every voxel of the grid is outside or inside. What was seen with weight enough is what its distance says. Of the
/// rest, empty voxels are outside, others what their distance says if they were seen at all, and inside if they were
/// not. Empty voxels to which no free space leads (find_free_space) are inside after all. If nothing is beyond the
/// grid, the voxels at its border are outside whatever was seen there.
///
/// A vertex lies on every edge between outside and inside: the measured one if its edge has one that faces the same way
/// and is confident enough, else a filled one in the middle, with confidence 0. Then what is not a hole is taken away
/// (drop_unbounded), and filled vertices get colors and positions from around (smooth_filled).
/// The same bytes for any number of threads.
class FilledSurface {
 public:
  /// measured: with weights. min_confidence: of a voxel that counts as seen, and of a measured vertex; >= 0.
  FilledSurface(MeasuredSurface measured, EmptySpace empty, float min_confidence);

  /// Vertices, with those that will be dropped.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  /// Blocks that the surface passes.
  [[nodiscard]] std::size_t block_count() const { return active_.size(); }

  /// The surface before settle_filled; the object is used up.
  Mesh extract();
  /// The surface; the object is used up.
  Mesh finish();

 private:
  MeasuredSurface measured_;
  std::vector<BlockBits> outside_;     // of all blocks of the grid
  std::vector<std::uint32_t> active_;  // blocks with cubes that are not all outside or all inside
  std::size_t vertex_count_ = 0;
  float min_confidence_;
  bool knows_background_;
};

}  // namespace quorum
