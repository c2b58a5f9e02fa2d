// The distance of a point to a triangle, in double.
#pragma once

#include <Eigen/Core>

namespace quorum {

/// Distance of a point to a triangle, scene units, and its square. Corners that lie on a line or in a point are a
/// segment or a point.
double distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c);
double squared_distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c);

}  // namespace quorum
