#include "engine/depth/depth_planes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace quorum {
namespace {

constexpr std::size_t kMaxPlanes = 65535;

/// Points by which the motion of a projection is measured: for a view with a depth range a grid of its pixels at both
/// ends of the range, else the corners and the center of the bounds.
std::vector<Eigen::Vector3d> probe_points(const Scene& scene, const View& view) {
  std::vector<Eigen::Vector3d> points;
  if (view.far_depth > 0) {
    constexpr int kSide = 5;
    for (const double depth : {view.near_depth, view.far_depth})
      for (int i = 0; i < kSide * kSide; ++i)
        points.push_back(view.camera.unproject((view.width - 1.0) * (i % kSide) / (kSide - 1),
                                               (view.height - 1.0) * (i / kSide) / (kSide - 1), depth));
    return points;
  }
  for (int corner = 0; corner < 8; ++corner) points.push_back(scene.bounds.corner(corner));
  points.push_back(scene.bounds.center());
  return points;
}

bool shows(const View& view, const Eigen::Vector3d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= view.width - 1 && pixel.y() <= view.height - 1;
}

/// Largest motion of the projection in a neighbor, pixels per unit of inverse depth, over the probe points; with a
/// depth range, where the neighbor shows them.
double largest_motion(const Scene& scene, int reference, const std::vector<int>& neighbors) {
  const View& view = scene.views[static_cast<std::size_t>(reference)];
  double largest = 0.0;
  for (const Eigen::Vector3d& point : probe_points(scene, view)) {
    const Eigen::Vector3d pixel = view.camera.project(point);
    if (pixel.z() <= 0) continue;
    const double inverse_depth = 1.0 / pixel.z();
    const double nudge = 1e-4 * inverse_depth;
    const Eigen::Vector3d moved = view.camera.unproject(pixel.x(), pixel.y(), 1.0 / (inverse_depth + nudge));
    for (const int neighbor : neighbors) {
      const View& other = scene.views[static_cast<std::size_t>(neighbor)];
      const Eigen::Vector3d from = other.camera.project(point);
      const Eigen::Vector3d to = other.camera.project(moved);
      if (from.z() <= 0 || to.z() <= 0 || (view.far_depth > 0 && !shows(other, from))) continue;
      largest = std::max(largest, (to - from).head<2>().norm() / nudge);
    }
  }
  return largest;
}

}  // namespace

float DepthPlanes::step() const {
  const double count = std::max(static_cast<double>(inverse_depth.size()) - 1.0, 1.0) / refinement;
  return static_cast<float>((static_cast<double>(inverse_depth.front()) - inverse_depth.back()) / count);
}

Expected<DepthPlanes> make_depth_planes(const Scene& scene, int reference, const std::vector<int>& neighbors,
                                        const SweepOptions& options) {
  const View& view = scene.views[static_cast<std::size_t>(reference)];
  double near = std::numeric_limits<double>::infinity();
  double far = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const double depth = view.camera.to_camera(scene.bounds.corner(corner)).z();
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  if (far <= 0.0)
    return failure(ErrorKind::kInput, fmt::format("{}: the bounds lie behind this camera; check --bounds", view.name));
  if (view.far_depth > 0) {
    far = std::min(far, view.far_depth);
    near = std::min(std::max(near, view.near_depth), far);
  }
  near = std::max(near, far * 1e-3);  // a camera inside the bounds: start close before it

  DepthPlanes planes;
  planes.refinement = options.refinement;
  const auto refuse = [&](double count) {
    return failure(ErrorKind::kUsage,
                   fmt::format("{}: {:.0f} depth samples are more than {}; give a larger --depth-step or --step-pixels",
                               view.name, count, kMaxPlanes));
  };
  if (options.depth_step > 0.0) {
    const double count = (std::floor((far - near) / options.depth_step) + 2.0) * options.refinement + 1.0;
    if (count > static_cast<double>(kMaxPlanes)) return refuse(count);
    for (int index = 0; index < static_cast<int>(count); ++index) {
      const double depth = near + options.depth_step * index / options.refinement;
      planes.depth.push_back(static_cast<float>(depth));
      planes.inverse_depth.push_back(static_cast<float>(1.0 / depth));
    }
  } else {
    const double motion = largest_motion(scene, reference, neighbors);
    const double span = 1.0 / near - 1.0 / far;
    const double steps = std::max(1.0, std::ceil(span * motion / options.automatic_step_pixels()));
    const double count = (steps + 1.0) * options.refinement + 1.0;
    if (!(count <= static_cast<double>(kMaxPlanes))) return refuse(count);
    for (int index = 0; index < static_cast<int>(count); ++index) {
      const double inverse_depth = 1.0 / near - span * index / (steps * options.refinement);
      if (inverse_depth <= 0.0) break;  // the one step behind the far end of bounds that are very deep
      planes.depth.push_back(static_cast<float>(1.0 / inverse_depth));
      planes.inverse_depth.push_back(static_cast<float>(inverse_depth));
    }
  }
  return planes;
}

Grid<PlaneRange> make_plane_ranges(const View& view, const Bounds& bounds, const Mask& mask, const DepthPlanes& planes,
                                   int radius) {
  std::vector<double> first_pass;
  for (std::size_t plane = 0; plane < planes.depth.size(); plane += static_cast<std::size_t>(planes.refinement))
    first_pass.push_back(planes.depth[plane]);

  const Eigen::Vector3d origin = view.camera.center();
  const Eigen::Matrix3d world_from_pixel = view.camera.camera_from_world.transpose() * view.camera.intrinsics.inverse();
  Grid<PlaneRange> ranges(view.width, view.height, PlaneRange{1, 0});
  for (int y = radius; y < view.height - radius; ++y) {
    for (int x = radius; x < view.width - radius; ++x) {
      if (!mask.empty() && mask.at(x, y) == 0) continue;
      const Eigen::Vector3d ray = world_from_pixel * Eigen::Vector3d(x, y, 1.0);  // reaches depth 1
      double enter = 0.0;
      double leave = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        if (ray(axis) == 0.0) {
          if (origin(axis) < bounds.low(axis) || origin(axis) > bounds.high(axis)) leave = -1.0;
          continue;
        }
        const double a = (bounds.low(axis) - origin(axis)) / ray(axis);
        const double b = (bounds.high(axis) - origin(axis)) / ray(axis);
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter > leave) continue;
      const auto begin = std::upper_bound(first_pass.begin(), first_pass.end(), enter);
      const auto end = std::lower_bound(first_pass.begin(), first_pass.end(), leave);
      const auto first = begin == first_pass.begin() ? begin : begin - 1;
      const auto last = end == first_pass.end() ? end - 1 : end;
      if (first > last) continue;
      const auto plane = [&](auto position) {
        return static_cast<uint>(position - first_pass.begin()) * static_cast<uint>(planes.refinement);
      };
      ranges.at(x, y) = {plane(first), plane(last)};
    }
  }
  return ranges;
}

}  // namespace quorum
