#include "engine/texture/seam_colors.h"

#include <oneapi/tbb/parallel_for.h>

#include "engine/texture/sample_color.h"

namespace quorum {

std::vector<std::vector<std::uint32_t>> seams_by_view(const PatchVertices& patch_vertices, std::size_t view_count) {
  std::vector<std::vector<std::uint32_t>> places(view_count);
  for (std::uint32_t i = 0; i < patch_vertices.views.size(); ++i)
    if (patch_vertices.is_on_seam(patch_vertices.vertices[i]))
      places[static_cast<std::size_t>(patch_vertices.views[i])].push_back(i);
  return places;
}

void sample_seams(const Mesh& mesh, const PatchVertices& patch_vertices, const std::vector<std::uint32_t>& places,
                  const View& view, const ColorImage& photograph, std::vector<LevelShift>& colors) {
  constexpr int kReach = 2;
  constexpr float kSamples = (2 * kReach + 1) * (2 * kReach + 1);
  const Projector project(view.camera);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    const Vertex& vertex = mesh.vertices[patch_vertices.vertices[places[i]]];
    const ProjectedVertex place = snap(project(vertex.position.cast<double>()));
    std::array<std::int32_t, 3> sums{};
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const auto color = sample_color(photograph, place.x + dx * kSubpixels, place.y + dy * kSubpixels);
        for (int channel = 0; channel < 3; ++channel) sums[channel] += color[channel];
      }
    for (int channel = 0; channel < 3; ++channel)
      colors[places[i]][channel] = static_cast<float>(sums[channel]) / (kSamples * kSubpixels);
  });
}

}  // namespace quorum
