// A mesh whose triangles carry pieces of photographs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"
#include "engine/mesh/mesh.h"

namespace quorum {

/// Pictures of one or more pages, and where in them each triangle lies. A vertex at the border of two charts is there
/// once for each of them, so that each has coordinates of its own. Triangles without a page, which come last, have the
/// colors of their vertices: no photograph shows them.
struct TexturedMesh {
  Mesh mesh = {};                                 ///< vertices in the order of their pages
  std::vector<Eigen::Vector2f> coordinates = {};  ///< per vertex: from the left and from the top of its page, 0..1
  std::vector<ColorImage> pages = {};
  std::vector<std::uint32_t> first_triangles = {};  ///< per page, and of those without; then the number of triangles
  std::vector<std::uint32_t> first_vertices = {};   ///< likewise

  /// Triangles that no photograph shows.
  [[nodiscard]] std::uint32_t unseen_triangles() const {
    return first_triangles.empty() ? 0 : first_triangles.back() - first_triangles[pages.size()];
  }
};

}  // namespace quorum
