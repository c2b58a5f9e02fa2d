// What two views share, and how well their rays fix it, from cameras and bounds alone: points sampled along the rays of
// a view stand for a surface that nobody knows yet.
#pragma once

#include <vector>

#include "engine/scene/scene.h"

namespace quorum {

/// A point on a ray of a view.
struct RayPoint {
  Eigen::Vector3d position;      ///< world
  Eigen::Vector3d to_view;       ///< unit vector to the view's center
  double pixels_per_unit = 0.0;  ///< of the view, at the point
};

/// What takes some of the points for all takes every so many-th: no factor in common with the points of a ray, so all
/// depths take part.
constexpr std::size_t kRayStride = 7;

/// Points along 8 x 8 rays of the view, 8 on each, evenly in depth where the ray is inside the bounds and the view's
/// depth range. Empty if no ray meets the bounds.
std::vector<RayPoint> sample_rays(const View& view, const Bounds& bounds);

/// Least angle between two rays that shows depth, degrees: what moves the projection by kLeastParallaxPixels, and at
/// least kLeastParallaxDeg, since no pose is exact.
constexpr double kLeastParallaxPixels = 4.0;
constexpr double kLeastParallaxDeg = 0.2;
double least_parallax_deg(const Camera& camera);

/// Median angle under which some of the points see the view's center and another, degrees; 0 without points.
double parallax_deg(const std::vector<RayPoint>& points, const Eigen::Vector3d& other_center);

/// min(1, (angle / 10 deg)^2): how well two rays fix a point.
double angle_weight(double angle_deg);

/// ratio: pixels of a neighbor view to one of the reference, along a line. 1 up to twice as fine.
double resolution_weight(double ratio);

/// Mean of both focal lengths, pixels.
double focal_pixels(const Camera& camera);

/// Whether the point lies before the view and projects onto a pixel of its image.
bool is_in_image(const View& view, const Eigen::Vector3d& point);

/// Pixels that show one unit of length at the point; 0 behind the camera.
double pixels_per_unit(const Camera& camera, const Eigen::Vector3d& point);

/// Neighbors of scene.views[reference], best first, at most count: one view after the other, each time the one of the
/// highest score, the sum over the sampled points that it sees of angle_weight, resolution_weight and a fall-off beyond
/// 45 degrees down to 0 at max_angle_deg, times as much again for each view already taken that sees the point.
/// Views without parallax, copies, and those of less than a fiftieth of the first one's score are not taken. Of about
/// equal scores the first in the scene wins, so that the rounding of a machine decides nothing.
/// In scenes of more than kManyViews the candidates are kCandidates of the nearest views, the nearest and farther ones.
constexpr std::size_t kManyViews = 1000;
constexpr std::size_t kCandidates = 64;
std::vector<int> select_by_parallax(const Scene& scene, int reference, int count, double max_angle_deg);

/// The sum of the scores that select_by_parallax would have added up had it taken these neighbors, in this order, on
/// points along the middle half of each ray: near the cameras of a large box any baseline looks wide.
double parallax_score(const Scene& scene, int reference, const std::vector<int>& neighbors, double max_angle_deg);

}  // namespace quorum
