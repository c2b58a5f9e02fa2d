// A pinhole camera, and the conventions of the whole project.
//
//      0   1   2  -> x (right)          world to camera:  point_in_camera = R · point_in_world + t
//    +---+---+---+                      camera to pixel:  (x, y, 1) ~ K · point_in_camera
//  0 | o |   |   |   An integer         camera axes:      x right, y down, z forward
//    +---+---+---+   coordinate is      depth:            z of point_in_camera, the distance along the
//  1 |   |   |   |   the CENTER of a                      optical axis in scene units; 0 = none
//    +---+---+---+   pixel: o = (0, 0)  rows:             from the top, in memory and in files
//  y (down)                                               (PFM files alone store the bottom row first)
#pragma once

#include <Eigen/Core>
#include <string>

namespace quorum {

/// Camera of one view. K is upper triangular with K(2,2) = 1; R is a rotation.
struct Camera {
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();         ///< K, pixels
  Eigen::Matrix3d camera_from_world = Eigen::Matrix3d::Identity();  ///< R
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();            ///< t, scene units

  /// R p + t.
  [[nodiscard]] Eigen::Vector3d to_camera(const Eigen::Vector3d& point_in_world) const {
    return camera_from_world * point_in_world + translation;
  }
  /// Pixel of a world point, with its depth as third component. A depth of zero or less means behind the camera;
  /// the pixel is then meaningless.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point_in_world) const;
  /// World point on the ray of a pixel at a depth.
  [[nodiscard]] Eigen::Vector3d unproject(double x, double y, double depth) const;
  /// Position of the center of projection in the world.
  [[nodiscard]] Eigen::Vector3d center() const { return -camera_from_world.transpose() * translation; }
  /// Unit vector along which the camera looks, in the world.
  [[nodiscard]] Eigen::Vector3d optical_axis() const { return camera_from_world.row(2).transpose(); }
};

/// Angle between the optical axes of two cameras, degrees, 0 to 180.
double optical_axis_angle_deg(const Camera& a, const Camera& b);

/// Says why K or R is no camera ("K is singular", "R is not a rotation: …"), or null if it is one.
const char* camera_defect(const Camera& camera);

/// Says which value of a camera, that is one, no photograph of this size, in pixels, was taken with, and why: a focal
/// length that shows more than 157 or less than 0.0006 degrees, focal lengths that differ tenfold, a principal point a
/// hundred pictures away, a position beyond 1e13. Empty if all can be.
std::string absurd_value(const Camera& camera, int width, int height);

/// What helps where a camera has a defect or an absurd value.
inline constexpr const char* kCameraRemedy = "correct it, or leave the view out";

}  // namespace quorum
