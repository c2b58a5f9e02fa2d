#include "engine/texture/blend_band.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace quorum {
namespace {

/// How far a patch vertex is from the seam.
struct FromSeam {
  double distance = -1;      ///< along edges of its patch, scene units; below 0 = not in the band
  std::uint32_t vertex = 0;  ///< of the seam, that is nearest
};

double edge_length(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = double{mesh.vertices[a].position[axis]} - double{mesh.vertices[b].position[axis]};
    square += along * along;
  }
  return std::sqrt(square);
}

/// Dijkstra's shortest ways from all seams at once; equally far ones in the order of their patch vertices.
std::vector<FromSeam> ways_from_seams(const Mesh& mesh, const MeshLinks& links, const std::vector<std::int32_t>& views,
                                      const PatchVertices& patch_vertices, double width) {
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, patch vertex, vertex of the seam
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  for (std::uint32_t i = 0; i < patch_vertices.views.size(); ++i)
    if (patch_vertices.is_on_seam(patch_vertices.vertices[i])) open.emplace(0, i, patch_vertices.vertices[i]);
  std::vector<FromSeam> ways(patch_vertices.views.size());
  while (!open.empty()) {
    const auto [distance, place, seam] = open.top();
    open.pop();
    if (ways[place].distance >= 0) continue;
    ways[place] = {distance, seam};
    const std::uint32_t vertex = patch_vertices.vertices[place];
    for (const std::uint32_t triangle : links.around_vertex(vertex)) {
      if (views[triangle] != patch_vertices.views[place]) continue;
      for (const std::uint32_t other : mesh.triangles[triangle]) {
        const std::uint32_t next = patch_vertices.find(other, views[triangle]);
        const double farther = distance + edge_length(mesh, vertex, other);
        if (farther < width && ways[next].distance < 0) open.emplace(farther, next, seam);
      }
    }
  }
  return ways;
}

}  // namespace

std::vector<BlendPart> blend_band(const Mesh& mesh, const MeshLinks& links, const std::vector<std::int32_t>& views,
                                  const PatchVertices& patch_vertices, const std::vector<LevelShift>& shifts,
                                  const Candidates& candidates, double width) {
  if (!(width > 0)) return {};
  const std::vector<FromSeam> ways = ways_from_seams(mesh, links, views, patch_vertices, width);
  std::vector<BlendPart> parts;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (views[t] == kUnseen) continue;
    const auto begin = static_cast<std::ptrdiff_t>(parts.size());
    for (int corner = 0; corner < 3; ++corner) {
      const FromSeam& way = ways[patch_vertices.find(mesh.triangles[t][corner], views[t])];
      if (way.distance < 0) continue;
      const std::uint32_t first = patch_vertices.first[way.vertex];
      const std::uint32_t end = patch_vertices.first[way.vertex + 1];
      for (std::uint32_t i = first; i < end; ++i) {
        const std::int32_t view = patch_vertices.views[i];
        if (view == views[t] || candidates.find(t, static_cast<std::uint32_t>(view)) == nullptr) continue;
        auto part =
            std::find_if(parts.begin() + begin, parts.end(), [&](const BlendPart& p) { return p.view == view; });
        if (part == parts.end()) part = parts.insert(part, BlendPart{t, view, {}, {}});
        part->shares[corner] = static_cast<float>((1 - way.distance / width) / (end - first));
        part->shifts[corner] = shifts[i];
      }
    }
  }
  return parts;
}

}  // namespace quorum
