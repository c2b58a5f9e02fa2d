// The colors that photographs have where their patches meet.
#pragma once

#include <vector>

#include "engine/texture/patch_vertices.h"
#include "engine/texture/project_mesh.h"

namespace quorum {

/// Patch vertices at seams, by view.
std::vector<std::vector<std::uint32_t>> seams_by_view(const PatchVertices& patch_vertices, std::size_t view_count);

/// Mean color of 5 × 5 pixels around each of these patch vertices, which are of the view, levels.
void sample_seams(const Mesh& mesh, const PatchVertices& patch_vertices, const std::vector<std::uint32_t>& places,
                  const View& view, const ColorImage& photograph, std::vector<LevelShift>& colors);

}  // namespace quorum
