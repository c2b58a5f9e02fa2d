#include "engine/texture/mesh_links.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace quorum {
namespace {

std::uint32_t across(const Mesh& mesh, const MeshLinks& links, std::uint32_t triangle, int corner) {
  const auto& corners = mesh.triangles[triangle];
  const std::uint32_t to = corners[(corner + 1) % 3];
  std::uint32_t found = kNoTriangle;
  for (const std::uint32_t other : links.around_vertex(corners[corner])) {
    if (other == triangle || std::ranges::count(mesh.triangles[other], to) == 0) continue;
    if (found != kNoTriangle) return kNoTriangle;
    found = other;
  }
  return found;
}

}  // namespace

MeshLinks link_mesh(const Mesh& mesh) {
  MeshLinks links;
  links.first.resize(mesh.vertices.size() + 1);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++links.first[vertex + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) links.first[v + 1] += links.first[v];
  links.around.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(links.first.begin(), links.first.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) links.around[next[vertex]++] = t;
  links.neighbors.resize(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    for (int corner = 0; corner < 3; ++corner)
      links.neighbors[t][corner] = across(mesh, links, static_cast<std::uint32_t>(t), corner);
  });
  return links;
}

}  // namespace quorum
