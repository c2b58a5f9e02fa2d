// Where a ray is inside a box.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/core/bounds.h"

namespace quorum {

/// A part of a ray, in multiples of its direction from its origin; empty if enter > leave.
struct RaySpan {
  double enter = 0.0;
  double leave = 0.0;
  [[nodiscard]] bool empty() const { return enter > leave; }
};

/// The part of the ray from origin, in its direction alone, that is inside the box.
inline RaySpan ray_in_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, const Bounds& box) {
  RaySpan span{0.0, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    if (ray(axis) == 0.0) {
      if (origin(axis) < box.low(axis) || origin(axis) > box.high(axis)) span.leave = -1.0;
      continue;
    }
    const double a = (box.low(axis) - origin(axis)) / ray(axis);
    const double b = (box.high(axis) - origin(axis)) / ray(axis);
    span.enter = std::max(span.enter, std::min(a, b));
    span.leave = std::min(span.leave, std::max(a, b));
  }
  return span;
}

}  // namespace quorum
