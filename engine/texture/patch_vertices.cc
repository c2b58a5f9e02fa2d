#include "engine/texture/patch_vertices.h"

#include <algorithm>

namespace quorum {

PatchVertices make_patch_vertices(const MeshLinks& links, const std::vector<std::int32_t>& views) {
  PatchVertices made;
  made.first.push_back(0);
  const auto vertex_count = static_cast<std::uint32_t>(links.first.size() - 1);
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    const auto begin = static_cast<std::ptrdiff_t>(made.views.size());
    for (const std::uint32_t triangle : links.around_vertex(vertex))
      if (views[triangle] != kUnseen) made.views.push_back(views[triangle]);
    std::sort(made.views.begin() + begin, made.views.end());
    made.views.erase(std::unique(made.views.begin() + begin, made.views.end()), made.views.end());
    made.vertices.resize(made.views.size(), vertex);
    made.first.push_back(static_cast<std::uint32_t>(made.views.size()));
  }
  return made;
}

std::vector<LevelShift> shifts_to_mean(const Mesh& mesh, const std::vector<std::int32_t>& views,
                                       const PatchVertices& patch_vertices, const Candidates& candidates) {
  std::vector<LevelShift> shifts(patch_vertices.views.size());
  std::vector<float> counts(shifts.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (views[t] == kUnseen || candidates.find(t, static_cast<std::uint32_t>(views[t])) == nullptr) continue;
    std::array<int, 3> sums{};
    std::array<int, 3> chosen{};
    int agreeing = 0;
    for (const Candidate& candidate : candidates.of(t)) {
      if (candidate.disagrees) continue;
      ++agreeing;
      for (int channel = 0; channel < 3; ++channel) {
        sums[channel] += candidate.color[channel];
        if (static_cast<std::int32_t>(candidate.view) == views[t]) chosen[channel] = candidate.color[channel];
      }
    }
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      const std::uint32_t place = patch_vertices.find(vertex, views[t]);
      counts[place] += 1;
      for (int channel = 0; channel < 3; ++channel)
        shifts[place][channel] +=
            static_cast<float>(sums[channel]) / static_cast<float>(agreeing) - static_cast<float>(chosen[channel]);
    }
  }
  for (std::size_t i = 0; i < shifts.size(); ++i)
    for (float& channel : shifts[i]) channel /= std::max(1.0F, counts[i]);
  return shifts;
}

}  // namespace quorum
