#include "engine/depth/depth_planes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/option.h"
#include "engine/scene/ray_box.h"

namespace quorum {
namespace {

constexpr std::size_t kMaxPlanes = 65535;

bool shows(const View& view, const Eigen::Vector3d& pixel) {
  return pixel.z() > 0 && pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= view.width - 1 &&
         pixel.y() <= view.height - 1;
}

/// The pixel of a view that is the i-th of side * side over the whole image.
Eigen::Vector2d grid_pixel(const View& view, int i, int side) {
  return {(view.width - 1.0) * (i % side) / (side - 1), (view.height - 1.0) * (i / side) / (side - 1)};
}

/// Points by which the motion of a projection is measured: for a view with a depth range a grid of its pixels at both
/// ends of the range; else the corners and the center of the bounds, if the view shows them all; else what is inside
/// the bounds of the rays of its pixels, beyond the near depth.
struct ProbePoints {
  std::vector<Eigen::Vector3d> points;
  bool seen_only = true;  ///< they count only where the neighbor shows them
};

ProbePoints probe_points(const Scene& scene, const View& view, double near) {
  constexpr int kSide = 5;
  constexpr int kDepths = 4;
  ProbePoints probe;
  const auto add = [&](int i, double depth) {
    const Eigen::Vector2d pixel = grid_pixel(view, i, kSide);
    probe.points.push_back(view.camera.unproject(pixel.x(), pixel.y(), depth));
  };
  if (view.far_depth > 0) {
    for (const double depth : {view.near_depth, view.far_depth})
      for (int i = 0; i < kSide * kSide; ++i) add(i, depth);
    return probe;
  }
  bool whole = true;
  for (int corner = 0; corner < 8; ++corner) {
    probe.points.push_back(scene.bounds.corner(corner));
    whole = whole && shows(view, view.camera.project(probe.points.back()));
  }
  probe.points.push_back(scene.bounds.center());
  probe.seen_only = !whole;
  if (whole) return probe;
  probe.points.clear();
  const Eigen::Vector3d center = view.camera.center();
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector2d pixel = grid_pixel(view, i, kSide);
    RaySpan span = ray_in_box(center, view.camera.unproject(pixel.x(), pixel.y(), 1.0) - center, scene.bounds);
    span.enter = std::max(span.enter, near);
    if (span.empty()) continue;
    for (int k = 0; k < kDepths; ++k)
      add(i, 1.0 / (1.0 / span.enter + (1.0 / span.leave - 1.0 / span.enter) * k / (kDepths - 1)));
  }
  return probe;
}

/// The least depth at which two neighbors show what the view does, from no more than 60 degrees aside: what is closer
/// gets no quorum. At least a thousandth of the far depth.
double least_common_depth(const Scene& scene, const View& view, const std::vector<int>& neighbors, double far) {
  constexpr int kSide = 5;
  constexpr double kCloser = 0.95;
  constexpr double kLeastCosine = 0.5;
  const Eigen::Vector3d center = view.camera.center();
  double found = far;
  for (double depth = far; depth >= 1e-3 * far; depth *= kCloser) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const Eigen::Vector2d pixel = grid_pixel(view, i, kSide);
      const Eigen::Vector3d point = view.camera.unproject(pixel.x(), pixel.y(), depth);
      const auto seen = std::ranges::count_if(neighbors, [&](int neighbor) {
        const View& other = scene.views[static_cast<std::size_t>(neighbor)];
        const double cosine = (center - point).normalized().dot((other.camera.center() - point).normalized());
        return cosine >= kLeastCosine && shows(other, other.camera.project(point));
      });
      if (seen < 2) continue;
      found = depth;
      break;
    }
  }
  return found;
}

/// Largest motion of the projection in a neighbor, pixels per unit of inverse depth, over the probe points.
double largest_motion(const Scene& scene, int reference, const std::vector<int>& neighbors, double near) {
  const View& view = scene.views[static_cast<std::size_t>(reference)];
  const ProbePoints probe = probe_points(scene, view, near);
  double largest = 0.0;
  for (const Eigen::Vector3d& point : probe.points) {
    const Eigen::Vector3d pixel = view.camera.project(point);
    if (pixel.z() <= 0) continue;
    const double inverse_depth = 1.0 / pixel.z();
    const double nudge = 1e-4 * inverse_depth;
    const Eigen::Vector3d moved = view.camera.unproject(pixel.x(), pixel.y(), 1.0 / (inverse_depth + nudge));
    for (const int neighbor : neighbors) {
      const View& other = scene.views[static_cast<std::size_t>(neighbor)];
      const Eigen::Vector3d from = other.camera.project(point);
      const Eigen::Vector3d to = other.camera.project(moved);
      if (from.z() <= 0 || to.z() <= 0 || (probe.seen_only && !shows(other, from))) continue;
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
    return failure(ErrorKind::kInput,
                   fmt::format("{}: the bounds lie behind this camera; check {}", view.name, option_name("bounds")));
  if (view.far_depth > 0) {
    far = std::min(far, view.far_depth);
    near = std::min(std::max(near, view.near_depth), far);
  }
  const bool inside = near < far * 1e-3;  // the camera stands in the bounds
  if (inside) near = least_common_depth(scene, view, neighbors, far);

  DepthPlanes planes;
  planes.refinement = options.refinement;
  const auto refuse = [&](double count) {
    return failure(ErrorKind::kUsage,
                   fmt::format("{}: {:.6g} depth samples are more than {}; give a larger {} or {}", view.name, count,
                               kMaxPlanes, option_name("depth-step"), option_name("step-pixels")));
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
    const double motion = largest_motion(scene, reference, neighbors, near);
    if (inside && motion > 0.0) {  // what takes more planes than there can be is too close
      const double most = (kMaxPlanes - 1) / options.refinement - 2.0;
      near = std::max(near, 1.0 / (1.0 / far + most * options.automatic_step_pixels() / motion));
    }
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
      const RaySpan span = ray_in_box(origin, ray, bounds);
      if (span.empty()) continue;
      const auto begin = std::upper_bound(first_pass.begin(), first_pass.end(), span.enter);
      const auto end = std::lower_bound(first_pass.begin(), first_pass.end(), span.leave);
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
