// Embree's search tree over the triangles or points of a part of a surface, as distance.h uses it.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/error.h"
#include "engine/evaluate/triangle_distance.h"
#include "engine/mesh/mesh.h"

namespace quorum {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// A search tree over primitives that lie together. It holds boxes in coordinates of about -0.5 to 0.5, whatever their
/// unit and place.
struct PrimitiveTree {
  /// What one query carries through the trees.
  struct Search {
    const PrimitiveTree* tree = nullptr;
    Eigen::Vector3d point;
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  const Mesh* surface = nullptr;
  std::vector<std::uint32_t> primitives;  ///< triangles, or vertices where there are none
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< tree units per scene unit
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

  [[nodiscard]] Eigen::Vector3d vertex(std::size_t index) const {
    return surface->vertices[index].position.cast<double>();
  }

  [[nodiscard]] Eigen::Vector3d to_tree(const Eigen::Vector3d& point) const { return (point - center) * scale; }

  /// The corners of a primitive: one point three times in a cloud.
  [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t primitive) const {
    if (surface->triangles.empty()) return {vertex(primitive), vertex(primitive), vertex(primitive)};
    const auto& [a, b, c] = surface->triangles[primitive];
    return {vertex(a), vertex(b), vertex(c)};
  }

  [[nodiscard]] double squared_distance(const Eigen::Vector3d& point, std::uint32_t primitive) const {
    if (surface->triangles.empty()) return (point - vertex(primitive)).squaredNorm();
    const auto& [a, b, c] = corners(primitive);
    return squared_distance_to_triangle(point, a, b, c);
  }

  /// To the box of all primitives.
  [[nodiscard]] double squared_distance_to_box(const Eigen::Vector3d& point) const {
    return (point - point.cwiseMax(low).cwiseMin(high)).squaredNorm();
  }

  /// Radius within which Embree must look so that it can't miss a closer primitive: the margin exceeds its rounding of
  /// the query, the boxes and the distances between them.
  [[nodiscard]] float search_radius(double distance) const {
    constexpr double kMargin = 1e-6;
    return static_cast<float>(distance * scale * (1 + kMargin) + kMargin);
  }

  /// Takes those of the primitives that lie together, at least half, and leaves the others.
  static std::unique_ptr<PrimitiveTree> take_cluster(const Mesh& surface, std::vector<std::uint32_t>& primitives);
  Expected<void> build();
  void look_for_closer(Search& search) const;

  static void bound_primitive(const RTCBoundsFunctionArguments* arguments);
  static bool visit_primitive(RTCPointQueryFunctionArguments* arguments);
};

}  // namespace quorum
