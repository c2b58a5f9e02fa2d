// The surface at signed distance zero in the voxel blocks (Lorensen and Cline 1987; the paper, section 2.2).
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// Triangles in every cube whose eight corners were all seen (weight above 0); what was not seen stays open. Vertices
/// are shared, also across blocks, and sorted by block, voxel and axis; triangles by block and voxel. Normals are means
/// of the triangles around, by area; color and confidence (accumulated weight) are interpolated along the edge.
/// Runs on all cores; the same bytes for any number of threads.
Mesh marching_cubes(const BlockPool& pool, const VoxelGrid& grid);

}  // namespace quorum
