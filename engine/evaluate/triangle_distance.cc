#include "engine/evaluate/triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace quorum {
namespace {

double squared_distance_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared_length = along.squaredNorm();
  const double t = squared_length > 0 ? std::clamp((point - a).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (point - a - t * along).squaredNorm();
}

}  // namespace

double squared_distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  // The edges alone are right for points beside the triangle, and for slivers: below this ratio of height to length the
  // inside differs from the edges by less than doubles resolve, but its normal may point anywhere.
  constexpr double kSliver = 1e-12;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d bc = c - b;
  const Eigen::Vector3d ca = a - c;
  const Eigen::Vector3d normal = ab.cross(-ca);
  const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  const Eigen::Vector3d from_a = point - a;
  const bool above_inside = normal.norm() > kSliver * longest && normal.cross(ab).dot(from_a) >= 0 &&
                            normal.cross(bc).dot(point - b) >= 0 && normal.cross(ca).dot(from_a) >= 0;
  if (above_inside) {
    const double height = normal.dot(from_a);
    return height * height / normal.squaredNorm();
  }
  return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                   squared_distance_to_segment(point, c, a)});
}

double distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  return std::sqrt(squared_distance_to_triangle(point, a, b, c));
}

}  // namespace quorum
