// Vertices with the views of the patches that meet there: where the colors of two photographs have to fit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/choose_views.h"

namespace quorum {

using LevelShift = std::array<float, 3>;  ///< red, green, blue, levels

/// A vertex is there once for each view that triangles around it are taken from; at a seam there are several.
struct PatchVertices {
  std::vector<std::uint32_t> first = {};     ///< per vertex, and at the end: where its patch vertices begin
  std::vector<std::int32_t> views = {};      ///< per patch vertex; ascending for each vertex
  std::vector<std::uint32_t> vertices = {};  ///< per patch vertex

  [[nodiscard]] bool is_on_seam(std::uint32_t vertex) const { return first[vertex + 1] - first[vertex] > 1; }
  /// The patch vertex of a view that is there.
  [[nodiscard]] std::uint32_t find(std::uint32_t vertex, std::int32_t view) const {
    std::uint32_t place = first[vertex];
    while (views[place] != view) ++place;
    return place;
  }
};

PatchVertices make_patch_vertices(const MeshLinks& links, const std::vector<std::int32_t>& views);

/// What would make each patch vertex the mean of the photographs that agree: over its triangles, their candidates' mean
/// less the color of the chosen one; 0 where that is not among them.
std::vector<LevelShift> shifts_to_mean(const Mesh& mesh, const std::vector<std::int32_t>& views,
                                       const PatchVertices& patch_vertices, const Candidates& candidates);

/// A shift of levels for each patch vertex, so that photographs have equal colors at seams (Waechter, Moehrle, Goesele
/// 2014, section 3.2; Lempitsky, Ivanov 2007): the least sum of squares of 16 × what is left at seams, of differences
/// of shifts along edges within a patch, and, which the source does not have, of 0.3 × the difference from
/// shifts_to_mean. The last keeps patches from drifting, and a gloss that one photograph caught from staying. colors:
/// of patch vertices at seams in their photographs, levels. By conjugate gradients in scalar double, in a fixed order.
std::vector<LevelShift> level_seams(const Mesh& mesh, const std::vector<std::int32_t>& views,
                                    const PatchVertices& patch_vertices, const std::vector<LevelShift>& colors,
                                    const std::vector<LevelShift>& to_mean);

}  // namespace quorum
