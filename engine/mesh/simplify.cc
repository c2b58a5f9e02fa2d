#include "engine/mesh/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "engine/mesh/make_manifold.h"

namespace quorum {

Mesh simplify(const Mesh& mesh, const SimplifyOptions& options, double* error) {
  Mesh result = make_manifold(mesh);
  if (error != nullptr) *error = 0;
  if (result.triangles.empty()) return result;
  const std::size_t index_count = result.triangles.size() * 3;
  const std::uint32_t* indices = result.triangles.front().data();
  const float* positions = result.vertices.front().position.data();
  const auto scale = static_cast<double>(meshopt_simplifyScale(positions, result.vertices.size(), sizeof(Vertex)));
  constexpr double kAny = 1e3;  // in extents of the mesh
  const auto bound = static_cast<float>(std::min(options.error / scale, kAny));
  const std::size_t wanted = std::min<std::uint64_t>(options.triangles, result.triangles.size()) * 3;

  std::vector<std::uint32_t> kept(index_count);
  float deviation = 0;
  kept.resize(meshopt_simplify(kept.data(), indices, index_count, positions, result.vertices.size(), sizeof(Vertex),
                               wanted, bound, meshopt_SimplifyLockBorder, &deviation));
  if (error != nullptr) *error = static_cast<double>(deviation) * scale;
  result.triangles.resize(kept.size() / 3);
  for (std::size_t i = 0; i < kept.size(); ++i) result.triangles[i / 3][i % 3] = kept[i];
  return make_manifold(result);
}

}  // namespace quorum
