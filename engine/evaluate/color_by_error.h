// A mesh in the colors of its distance from the truth, for looking at errors.
#pragma once

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"

namespace quorum {

/// The mesh with each vertex colored by its distance to the truth: from blue (0) over green (a third of
/// full_error) and yellow (two thirds) to red (full_error and more). full_error: scene units, above 0. Fails (kUsage)
/// if it is not, and as SurfaceDistance does.
Expected<Mesh> color_by_error(Mesh mesh, const Mesh& truth, double full_error);

}  // namespace quorum
