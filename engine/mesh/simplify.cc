#include "engine/mesh/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "engine/mesh/make_manifold.h"

namespace quorum {
namespace {

constexpr double kAny = 1e3;  // a deviation, in extents of the mesh

struct Simplified {
  std::vector<std::uint32_t> corners;
  float deviation = 0;  ///< in extents
};

/// locked: vertices of borders stay.
Simplified collapse_edges(const Mesh& mesh, std::size_t triangles, float bound, bool locked) {
  const std::size_t corners = mesh.triangles.size() * 3;
  Simplified result{std::vector<std::uint32_t>(corners)};
  result.corners.resize(meshopt_simplify(result.corners.data(), mesh.triangles.front().data(), corners,
                                         mesh.vertices.front().position.data(), mesh.vertices.size(), sizeof(Vertex),
                                         triangles * 3, bound, locked ? meshopt_SimplifyLockBorder : 0,
                                         &result.deviation));
  return result;
}

/// With borders as they are, unless that takes twice the deviation, or more triangles than wanted.
Simplified collapse_edges(const Mesh& mesh, std::size_t triangles, float bound) {
  Simplified locked = collapse_edges(mesh, triangles, bound, true);
  if (triangles == 0) return locked;
  Simplified free = collapse_edges(mesh, triangles, bound, false);
  const bool is_near = locked.deviation <= 2 * free.deviation;
  return is_near && locked.corners.size() <= std::max(triangles * 3, free.corners.size()) ? locked : free;
}

}  // namespace

Mesh simplify(const Mesh& mesh, const SimplifyOptions& options, double* error) {
  Mesh result = make_manifold(mesh);
  if (error != nullptr) *error = 0;
  if (result.triangles.empty()) return result;
  const auto scale = static_cast<double>(
      meshopt_simplifyScale(result.vertices.front().position.data(), result.vertices.size(), sizeof(Vertex)));
  const auto bound = static_cast<float>(std::min(options.error / scale, kAny));
  const Simplified simple =
      collapse_edges(result, std::min<std::uint64_t>(options.triangles, result.triangles.size()), bound);
  if (error != nullptr) *error = static_cast<double>(simple.deviation) * scale;
  result.triangles.resize(simple.corners.size() / 3);
  for (std::size_t i = 0; i < simple.corners.size(); ++i) result.triangles[i / 3][i % 3] = simple.corners[i];
  return make_manifold(result);
}

}  // namespace quorum
