#include "engine/mesh/clean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Removes the triangles of which the predicate is true and says how many they were.
template <typename Predicate>
std::uint64_t drop_triangles(std::vector<Triangle>& triangles, Predicate is_dropped) {
  return static_cast<std::uint64_t>(std::erase_if(triangles, is_dropped));
}

/// Sets of vertices that triangles join, named by their lowest vertex.
class Components {
 public:
  Components(const Mesh& mesh, const std::vector<Triangle>& triangles)
      : sets_(mesh.vertices.size()), triangles_(mesh.vertices.size()) {
    for (const Triangle& triangle : triangles) {
      sets_.join(triangle[0], triangle[1]);
      sets_.join(triangle[0], triangle[2]);
    }
    for (const Triangle& triangle : triangles)
      if (std::ranges::all_of(triangle, [&](std::uint32_t v) { return mesh.vertices[v].confidence > 0.0F; }))
        ++triangles_[find(triangle[0])];
  }

  std::uint32_t find(std::uint32_t vertex) { return sets_.find(vertex); }

  /// Measured triangles in the component of a vertex.
  std::uint64_t size(std::uint32_t vertex) { return triangles_[find(vertex)]; }

  /// Measured triangles in the component that has the most. There is at least one vertex.
  [[nodiscard]] double largest_size() const { return static_cast<double>(triangles_[largest()]); }

  /// Representative of the component with the most triangles; of equal ones the lowest. There is at least one vertex.
  [[nodiscard]] std::uint32_t largest() const {
    return static_cast<std::uint32_t>(std::ranges::max_element(triangles_) - triangles_.begin());
  }

 private:
  DisjointSets sets_;
  std::vector<std::uint64_t> triangles_;  ///< at representatives: measured triangles in the component
};

/// The vertices that stay, and triangles that count them anew.
Mesh keep_vertices(const Mesh& mesh, std::vector<Triangle> triangles, const std::vector<bool>& kept) {
  Mesh result;
  result.offset = mesh.offset;
  std::vector<std::uint32_t> new_index(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!kept[v]) continue;
    new_index[v] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[v]);
  }
  for (Triangle& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner = new_index[corner];
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace

float automatic_min_confidence(const std::vector<Vertex>& vertices, float most) {
  constexpr float kShareOfMedian = 0.125F;
  if (vertices.empty()) return 0.0F;
  std::vector<float> confidences;
  confidences.reserve(vertices.size());
  for (const Vertex& vertex : vertices) confidences.push_back(vertex.confidence);
  const auto middle = confidences.begin() + static_cast<std::ptrdiff_t>(confidences.size() / 2);
  std::nth_element(confidences.begin(), middle, confidences.end());
  return std::min(most, kShareOfMedian * *middle);
}

Mesh clean(const Mesh& mesh, const CleanOptions& options, CleanCounts* counts) {
  CleanCounts dropped;
  const auto is_confident = [&](std::uint32_t v) { return mesh.vertices[v].confidence >= options.min_confidence; };
  std::vector<Triangle> triangles = mesh.triangles;
  dropped.low_confidence_triangles =
      drop_triangles(triangles, [&](const Triangle& triangle) { return !std::ranges::all_of(triangle, is_confident); });

  Components components(mesh, triangles);
  const double least_share = triangles.empty() ? 0.0 : options.min_component_share * components.largest_size();
  const auto is_small = [&](const Triangle& triangle) {
    const std::uint64_t size = components.size(triangle[0]);
    return size < options.min_component_triangles || static_cast<double>(size) < least_share;
  };
  if (!std::ranges::all_of(triangles, is_small))
    dropped.small_component_triangles = drop_triangles(triangles, is_small);
  if (options.largest_component && !triangles.empty()) {
    const std::uint32_t largest = components.largest();
    dropped.other_component_triangles =
        drop_triangles(triangles, [&](const Triangle& triangle) { return components.find(triangle[0]) != largest; });
  }

  const bool is_cloud = mesh.triangles.empty();
  std::vector<bool> kept(mesh.vertices.size(), is_cloud);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) kept[corner] = true;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_confident(v)) {
      kept[v] = false;
      ++dropped.low_confidence_vertices;
    } else if (!kept[v]) {
      ++dropped.unreferenced_vertices;
    }
  }
  if (counts != nullptr) *counts = dropped;
  return keep_vertices(mesh, std::move(triangles), kept);
}

std::uint64_t count_pieces(const Mesh& mesh) {
  Components components(mesh, mesh.triangles);
  std::vector<bool> seen(mesh.vertices.size());
  std::uint64_t count = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const std::uint32_t piece = components.find(triangle[0]);
    if (!seen[piece]) ++count;
    seen[piece] = true;
  }
  return count;
}

}  // namespace quorum
