// Which places of a surface the views of a scene see. No photograph shows the others, so they say nothing of a
// reconstruction.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Lines of sight past a surface.
class Sight {
 public:
  /// Fails (kInput) if the surface has no triangles or a position that is not finite, and (kMemory, kDevice) if Embree
  /// can't build its search tree. The surface is not needed afterwards.
  static Expected<Sight> build(const Mesh& surface);

  /// True if a view sees a point of the surface: it lies before the camera, its pixel inside the image, and no part of
  /// the surface stands before it by more than the margin. margin: scene units. From several threads.
  [[nodiscard]] bool sees(const View& view, const Eigen::Vector3d& point, double margin) const;

  /// How many of the views see each point, in their order. In parallel.
  [[nodiscard]] std::vector<int> views_that_see(const std::vector<View>& views, std::span<const Eigen::Vector3d> points,
                                                double margin) const;

 private:
  struct Tree;
  Sight() = default;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace quorum
