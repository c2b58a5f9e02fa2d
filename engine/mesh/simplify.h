// Fewer triangles for the same surface, by edge collapses (Garland, Heckbert 1997, "Surface Simplification Using
// Quadric Error Metrics") as meshoptimizer does them.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/mesh/mesh.h"

namespace quorum {

struct SimplifyOptions {
  std::uint64_t triangles = 0;                             ///< stop when there are no more than this
  double error = std::numeric_limits<double>::infinity();  ///< largest deviation, scene units; > 0
};

/// A mesh of some of the same vertices, with all that is known of them, and of fewer triangles. No two parts grow
/// together, which can keep it above the wanted number. Borders stay where they are, so that holes stay holes, unless a
/// number of triangles is wanted and borders take so many of these that the surface would deviate more than twice as
/// far: then borders move by no more than the deviation, and holes that are smaller than it can close. What
/// make_manifold mends is mended. error: if given, receives the deviation, scene units, that
/// the quadrics estimate. Equal bytes on machines of one architecture with one version of the library.
Mesh simplify(const Mesh& mesh, const SimplifyOptions& options, double* error = nullptr);

}  // namespace quorum
