// Puts mesh and pages together.
#pragma once

#include <vector>

#include "engine/mesh/textured_mesh.h"
#include "engine/texture/charts.h"

namespace quorum {

/// The one place where vertices are split: once for each chart that they belong to, and once for the triangles without
/// view (kUnseen).
TexturedMesh assemble(const Mesh& mesh, const std::vector<std::int32_t>& views, const OwnPlaces& places,
                      const Charts& charts, std::vector<ColorImage> pages);

}  // namespace quorum
