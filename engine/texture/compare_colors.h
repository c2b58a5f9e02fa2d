// Whether a mesh is of the scene whose photographs are put on it.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/texture/candidates.h"

namespace quorum {

/// How far the colors of the mesh are from those that its photographs show: per triangle, levels of the channel that is
/// off most from the median of its candidates, three at least; the median of all these. 0 if the mesh has one color
/// alone, or no triangle has three candidates. Of scenes on their own meshes 1 to 8; on others' 32 to 117.
int color_difference(const Mesh& mesh, const Candidates& candidates);

}  // namespace quorum
