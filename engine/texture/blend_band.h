// Where two patches meet, one photograph passes into the other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/patch_vertices.h"

namespace quorum {

/// Of a photograph that takes part in a triangle beside its own one.
struct BlendPart {
  std::uint32_t triangle = 0;
  std::int32_t view = 0;
  std::array<float, 3> shares = {};       ///< at the corners, 0..1; those of a triangle's parts sum to less than 1
  std::array<LevelShift, 3> shifts = {};  ///< at the corners
};

/// The parts of all triangles, ascending by triangle. At a seam all views that meet there have the same share; from
/// there on it falls linearly to none at `width` along the edges, scene units. A view that does not show a triangle, or
/// disagrees, has no part in it. Departs from the source (section 3.2), which edits gradients in the band (Perez et al.
/// 2003): passing over also hides where photographs don't fit by a pixel.
std::vector<BlendPart> blend_band(const Mesh& mesh, const MeshLinks& links, const std::vector<std::int32_t>& views,
                                  const PatchVertices& patch_vertices, const std::vector<LevelShift>& shifts,
                                  const Candidates& candidates, double width);

}  // namespace quorum
