// An axis-aligned box in world coordinates, scene units.
#pragma once

#include <Eigen/Core>

namespace quorum {

struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();

  /// True if the box has a volume.
  [[nodiscard]] bool valid() const { return (high.array() > low.array()).all(); }
  [[nodiscard]] Eigen::Vector3d center() const { return (low + high) / 2.0; }
  [[nodiscard]] Eigen::Vector3d size() const { return high - low; }
  /// Corner 0 to 7; bit 0 of the index picks high x, bit 1 high y, bit 2 high z.
  [[nodiscard]] Eigen::Vector3d corner(int index) const {
    return {index & 1 ? high.x() : low.x(), index & 2 ? high.y() : low.y(), index & 4 ? high.z() : low.z()};
  }
  [[nodiscard]] Bounds expanded(double margin) const { return {low.array() - margin, high.array() + margin}; }
};

}  // namespace quorum
