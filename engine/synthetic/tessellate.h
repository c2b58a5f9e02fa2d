// Solids as triangles, whose corners lie on the exact surface.
#pragma once

#include <array>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/synthetic/shapes.h"

namespace quorum {

/// Coordinates along x, y and z at which flat rectangles are divided beside the regular steps.
using Cuts = std::array<std::vector<double>, 3>;

/// The whole surface of a solid: edges of at most max_edge, vertices shared within a face but not across its rim,
/// normals set. Round faces deviate by at most 0.01 mm; solids are in meters. max_edge: at least 0.1 mm.
Mesh tessellate(const Solid& solid, double max_edge, const Cuts& cuts);

}  // namespace quorum
