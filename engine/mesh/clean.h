// Removes what a reconstruction should not show: parts that few views support, and small parts that float.
#pragma once

#include <cstdint>

#include "engine/mesh/mesh.h"

namespace quorum {

struct CleanOptions {
  float min_confidence = 0;  ///< a triangle with a corner below this is dropped; >= 0
  std::uint64_t min_component_triangles =
      100;                         ///< a component with fewer measured triangles is dropped, unless all are small
  double min_component_share = 0;  ///< as is one with fewer than this share of the largest one's; 0 to 1
  bool largest_component = false;  ///< keep only the component with the most triangles
};

/// The least confidence that a vertex needs when the user names none: most, or an eighth of the median over the
/// vertices where that is lower, so that scenes in which every surface is seen by few views keep theirs. 0 for no
/// vertex. Where holes are filled, the vertices are those before triangles are made, and a few more than the mesh has.
/// Chosen by measurement: docs/measurements/fusion_defaults.md.
float automatic_min_confidence(const std::vector<Vertex>& vertices, float most = 0.045F);

/// What was dropped, each item under the first rule that it failed.
struct CleanCounts {
  std::uint64_t low_confidence_triangles = 0;
  std::uint64_t small_component_triangles = 0;
  std::uint64_t other_component_triangles = 0;  ///< not of the largest component
  std::uint64_t low_confidence_vertices = 0;
  std::uint64_t unreferenced_vertices = 0;  ///< confident, but of no triangle that stays
};

/// Drops triangles with a corner of low confidence, then components (triangles joined by shared vertices) that are too
/// small (triangles with a corner of confidence 0, which was filled in, don't count), unless all are, as in a scene of
/// few pixels, then, if wanted, all components
/// but the largest (of equal ones the one with the lowest vertex index), then vertices that no triangle uses. What
/// stays keeps its order. A cloud only loses its vertices of low confidence. counts: if given, receives what was
/// dropped. Empty for an empty mesh. Cannot fail.
Mesh clean(const Mesh& mesh, const CleanOptions& options, CleanCounts* counts = nullptr);

/// Components of a mesh.
std::uint64_t count_pieces(const Mesh& mesh);

}  // namespace quorum
