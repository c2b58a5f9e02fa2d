// Mends what other programs stumble over: triangles without area, and vertices at which pieces of a surface only touch.
#pragma once

#include "engine/mesh/mesh.h"

namespace quorum {

/// Corners at one place of a triangle without area become one vertex, the lowest, and the triangle goes. Then every
/// vertex belongs to one fan of triangles: each further fan gets a copy of the vertex, after all others. Triangles side
/// by side are those that share an edge which no third one has. Vertices that no triangle uses any more go, unless none
/// was used before: a cloud stays as it is. What stays keeps its order. Cannot fail.
Mesh make_manifold(Mesh mesh);

/// Drops vertices that no triangle uses. What stays keeps its order.
void drop_unused_vertices(Mesh& mesh);

}  // namespace quorum
