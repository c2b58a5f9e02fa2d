// Convex solids with exact ray intersection and inside test, of which the synthetic temple is built. World axes, y up.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "engine/core/bounds.h"

namespace quorum {

/// Points origin + t * direction, t > 0. The direction may have any length except zero.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// Where a ray enters a solid.
struct Hit {
  double t = 0;                                      ///< in lengths of the ray's direction
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, outward
};

/// A box along the axes.
struct Box {
  Bounds bounds;
};

/// An upright, round, tapered drum.
struct Drum {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();  ///< center of the lower disk
  double height = 0;
  double foot_radius = 0;
  double head_radius = 0;

  /// Growth of the radius per unit of height.
  [[nodiscard]] double slope() const { return (head_radius - foot_radius) / height; }
};

/// A roof: the base is the bottom rectangle of the bounds, the ridge runs along z in the middle of their top.
struct Gable {
  Bounds bounds;

  /// Unit outward normal of the roof slope on the side of x = side, which is -1 or 1.
  [[nodiscard]] Eigen::Vector3d slope_normal(double side) const;
};

using Solid = std::variant<Box, Drum, Gable>;

/// The smallest box around a solid.
Bounds bounds_of(const Solid& solid);

/// The point where a ray enters the solid; none if it misses, or starts inside or behind.
std::optional<Hit> intersect(const Solid& solid, const Ray& ray);

/// True if the point lies inside or at most `tolerance` outside each face; a negative tolerance asks for points at
/// least that deep inside.
bool contains(const Solid& solid, const Eigen::Vector3d& point, double tolerance);

}  // namespace quorum
