#include "engine/mesh/make_manifold.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <tuple>

#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// A side of a triangle, from its corner with the lower vertex to that with the higher one. Corners count through all
/// triangles.
struct Edge {
  std::uint32_t low, high;
  std::uint32_t low_corner, high_corner;
};

bool has_area(const Mesh& mesh, const Triangle& triangle) {
  const auto corner = [&](int i) -> Eigen::Vector3d {
    return mesh.vertices[triangle[static_cast<std::size_t>(i)]].position.cast<double>();
  };
  return !(corner(1) - corner(0)).cross(corner(2) - corner(0)).isZero(0);
}

/// Joins the corners at one place of each triangle without area, and drops those triangles.
void drop_flat_triangles(Mesh& mesh) {
  std::atomic<bool> found = false;
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    if (!has_area(mesh, mesh.triangles[t])) found = true;
  });
  if (!found) return;
  DisjointSets places(mesh.vertices.size());
  const auto position = [&](std::uint32_t v) -> const Eigen::Vector3f& { return mesh.vertices[v].position; };
  for (const Triangle& triangle : mesh.triangles) {
    if (has_area(mesh, triangle)) continue;
    for (const auto& [a, b] : {std::pair{0U, 1U}, {1U, 2U}, {2U, 0U}})
      if (position(triangle[a]) == position(triangle[b])) places.join(triangle[a], triangle[b]);
  }
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = places.find(corner);
  std::erase_if(mesh.triangles, [&](const Triangle& triangle) { return !has_area(mesh, triangle); });
}

/// The corners that belong to one fan around their vertex, named by the lowest.
DisjointSets find_fans(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges(3 * triangles.size());
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(triangles.size()), [&](std::uint32_t t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t j = (i + 1) % 3;
      const std::uint32_t a = triangles[t][i];
      const std::uint32_t b = triangles[t][j];
      edges[3 * t + i] = a < b ? Edge{a, b, 3 * t + i, 3 * t + j} : Edge{b, a, 3 * t + j, 3 * t + i};
    }
  });
  const auto key = [](const Edge& e) { return std::tuple(e.low, e.high, e.low_corner); };
  tbb::parallel_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  DisjointSets fans(3 * triangles.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
    if (end - begin != 2) continue;
    fans.join(edges[begin].low_corner, edges[begin + 1].low_corner);
    fans.join(edges[begin].high_corner, edges[begin + 1].high_corner);
  }
  return fans;
}

/// Gives each fan but the first of its vertex a copy of that vertex.
void split_fans(Mesh& mesh) {
  constexpr std::uint32_t kNone = ~0U;
  DisjointSets fans = find_fans(mesh.triangles);
  const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  std::vector<std::uint32_t> first_fan(mesh.vertices.size(), kNone);
  std::vector<std::uint32_t> vertex_of_fan(corners);
  for (std::uint32_t corner = 0; corner < corners; ++corner) {
    std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
    const std::uint32_t fan = fans.find(corner);
    if (fan == corner) {  // the lowest corner of its fan comes first
      const bool is_first = first_fan[vertex] == kNone;
      if (is_first) first_fan[vertex] = fan;
      vertex_of_fan[fan] = is_first ? vertex : static_cast<std::uint32_t>(mesh.vertices.size());
      if (!is_first) mesh.vertices.push_back(Vertex(mesh.vertices[vertex]));
    }
    vertex = vertex_of_fan[fan];
  }
}

}  // namespace

void drop_unused_vertices(Mesh& mesh) {
  std::vector<std::uint32_t> new_index(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) new_index[corner] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (new_index[v] == 0) continue;
    mesh.vertices[count] = mesh.vertices[v];
    new_index[v] = count++;
  }
  mesh.vertices.resize(count);
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = new_index[corner];
}

Mesh make_manifold(Mesh mesh) {
  if (mesh.triangles.empty()) return mesh;
  drop_flat_triangles(mesh);
  split_fans(mesh);
  drop_unused_vertices(mesh);
  return mesh;
}

}  // namespace quorum
