#include "tests/support/mesh_measures.h"

#include <Eigen/Geometry>
#include <map>
#include <utility>

namespace quorum {

MeshMeasures measure_mesh(const Mesh& mesh) {
  MeshMeasures measures;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges;
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3d corners[3];
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = mesh.vertices[triangle[i]].position.cast<double>();
      ++directed_edges[{triangle[i], triangle[(i + 1) % 3]}];
    }
    measures.area += 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    measures.volume += corners[0].dot(corners[1].cross(corners[2])) / 6.0;
  }
  int edges = 0;
  for (const auto& [edge, count] : directed_edges) {
    const auto reverse = directed_edges.find({edge.second, edge.first});
    if (count != 1 || reverse == directed_edges.end()) measures.closed = false;
    if (edge.first < edge.second || reverse == directed_edges.end()) ++edges;
  }
  measures.euler_characteristic =
      static_cast<int>(mesh.vertices.size()) - edges + static_cast<int>(mesh.triangles.size());
  return measures;
}

bool same_mesh(const Mesh& a, const Mesh& b) {
  static_assert(sizeof(Vertex) == 32);
  return a.vertices.size() == b.vertices.size() && a.triangles == b.triangles &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)) == 0;
}

}  // namespace quorum
