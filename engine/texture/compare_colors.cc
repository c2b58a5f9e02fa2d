#include "engine/texture/compare_colors.h"

#include <algorithm>
#include <cstdlib>

namespace quorum {
namespace {

constexpr std::size_t kFewest = 3;

/// Mean of the corners in a channel, 0 to 2 for red to blue.
int channel_of(const Mesh& mesh, std::size_t triangle, std::size_t channel) {
  std::uint32_t sum = 0;
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    const std::uint32_t color = mesh.vertices[vertex].color;
    sum += channel == 0 ? red_of(color) : channel == 1 ? green_of(color) : blue_of(color);
  }
  return static_cast<int>(sum / 3);
}

/// Of one triangle.
int difference_of(const Mesh& mesh, std::size_t triangle, std::span<const Candidate> candidates) {
  int most = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::array<int, Candidates::kMost> levels{};
    std::ranges::transform(candidates, levels.begin(), [channel](const Candidate& c) { return c.color[channel]; });
    const auto middle = levels.begin() + static_cast<std::ptrdiff_t>((candidates.size() - 1) / 2);
    std::nth_element(levels.begin(), middle, levels.begin() + static_cast<std::ptrdiff_t>(candidates.size()));
    most = std::max(most, std::abs(channel_of(mesh, triangle, channel) - *middle));
  }
  return most;
}

}  // namespace

int color_difference(const Mesh& mesh, const Candidates& candidates) {
  const auto is_first = [&](const Vertex& vertex) { return vertex.color == mesh.vertices.front().color; };
  if (std::ranges::all_of(mesh.vertices, is_first)) return 0;
  std::vector<int> differences;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (const auto of = candidates.of(t); of.size() >= kFewest) differences.push_back(difference_of(mesh, t, of));
  if (differences.empty()) return 0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::ranges::nth_element(differences, middle);
  return *middle;
}

}  // namespace quorum
