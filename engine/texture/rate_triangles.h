// How well each photograph shows each triangle (Waechter, Moehrle, Goesele 2014, "Let There Be Color!", section 3.1).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/image/image.h"
#include "engine/mesh/mesh.h"
#include "engine/texture/candidates.h"
#include "engine/texture/nearness_buffer.h"
#include "engine/texture/surface_normals.h"

namespace quorum {

/// What a triangle is looked up in.
struct RatedView {
  std::uint32_t index;
  Eigen::Vector3d center;  ///< of projection
  const ColorImage& image;
  const Mask& mask;  ///< or empty
  const ProjectedMesh& projected;
  const NearnessBuffer& nearness;  ///< of the same
};

/// Adds the view to the candidates of the triangles that it shows: whole, not masked out, from where the surface around
/// faces it (a triangle smaller than a pixel may face elsewhere), and with nothing in front of any corner, the middle
/// or any pixel by more than three pixels' footprint and the slope of the triangle. Quality is projected area (of the
/// surface around) × cosine of the angle to the normal × (mean gradient magnitude + 24), in levels, up to 72, and an
/// eighth of that within three pixels of an outline, where the mesh may reach beyond what it is of. Departs
/// from the source, which sums the magnitude alone: flat places would have no quality at all, and outlines before a
/// dark background the best.
void rate_triangles(const Mesh& mesh, const std::vector<SurfacePiece>& pieces, const RatedView& view,
                    Candidates& candidates);

}  // namespace quorum
