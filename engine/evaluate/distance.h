// Distance from points to the nearest place on a surface. Embree finds the candidates in single precision; the distance
// itself is computed in double from the corners, so the result depends neither on the search tree nor on the CPU.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"

namespace quorum {

struct PrimitiveTree;

/// A surface that distances can be taken to: a mesh or, without triangles, a cloud. Fails (kInput) if it has no vertex
/// or if a position is not finite.
Expected<void> check_surface(const Mesh& surface);

/// Unsigned distances to a mesh (nearest place on its triangles) or to a cloud (nearest point).
class SurfaceDistance {
 public:
  /// The surface is not copied and must outlive the object. Fails as check_surface does, and (kMemory, kDevice) if
  /// Embree can't build its search tree.
  static Expected<SurfaceDistance> build(const Mesh& surface);

  /// Distance of one point, scene units; the point is finite. From beyond 100,000 times the size of a part of the
  /// surface it is that to the part's box, which is at most that much closer. May be called from several threads.
  double operator()(const Eigen::Vector3d& point) const;

  /// Distance of each point, in their order. In parallel.
  [[nodiscard]] std::vector<double> to(std::span<const Eigen::Vector3d> points) const;

 private:
  SurfaceDistance() = default;
  std::vector<std::shared_ptr<const PrimitiveTree>> trees_;  ///< of parts of the surface that lie far apart
};

}  // namespace quorum
