// What becomes of the patches of a surface that were filled in: which of them are holes, their colors and their shape.
#pragma once

#include <vector>

#include "engine/mesh/mesh.h"

namespace quorum {

/// True if the vertex was filled in.
inline bool is_filled(const Vertex& vertex) { return vertex.confidence == 0.0F; }

/// Drops the triangles of filled vertices that are no hole. Filled vertices that triangles join make a patch. A patch
/// that reaches the border of the grid is the border of what is unknown beside the object, as it lies where no view has
/// a background; one that touches no measured vertex is unknown space by itself. So is a large one where no background
/// is known: it spans what views could not look through. at_border: of each vertex. largest_share: vertices of a patch,
/// at most, as a share of the measured ones.
void drop_unbounded(Mesh& mesh, const std::vector<char>& at_border, double largest_share);

/// Colors filled vertices by the means of their neighbors, ring by ring from the measured ones, and moves them to the
/// mean of their neighbors, rounds times; measured vertices stay. The staircase of voxels becomes a membrane.
void smooth_filled(Mesh& mesh, int rounds);

/// The last step: smooth_filled, and normals.
void settle_filled(Mesh& mesh);

}  // namespace quorum
