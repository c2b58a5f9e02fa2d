#include "engine/scene/local_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace quorum {
namespace {

/// values is reordered and not empty.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Adds to the world's positions of all that has one.
void move(Scene& scene, const Eigen::Vector3d& by) {
  for (View& view : scene.views) view.camera.translation -= view.camera.camera_from_world * by;
  for (SparsePoint& point : scene.points) point.position += by;
}

}  // namespace

Eigen::Vector3d far_offset(const Eigen::Vector3d& middle, double extent) {
  constexpr double kNear = 64.0;  // a float at this many extents errs by 4e-6 of one; voxels take some thousandth
  constexpr double kRounding = 1e-9;
  const double distance = middle.cwiseAbs().maxCoeff();
  const bool is_far = distance > kNear * extent && extent > kRounding * distance;  // what is one point has no extent
  if (!middle.allFinite() || !is_far) return Eigen::Vector3d::Zero();
  const double step = std::pow(10.0, std::floor(std::log10(extent)));
  return (middle / step).array().round() * step + 0.0;  // no -0
}

void enter_local_frame(Scene& scene) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3 && !scene.views.empty(); ++axis) {
    std::vector<double> values;
    for (const View& view : scene.views) values.push_back(view.camera.center()(axis));
    middle(axis) = median(values);
  }
  double extent = 0.0;
  for (const View& view : scene.views) extent = std::max(extent, (view.camera.center() - middle).norm());
  std::vector<double> distances;
  for (const SparsePoint& point : scene.points) distances.push_back((point.position - middle).norm());
  if (!distances.empty()) extent = std::max(extent, median(distances));
  const Eigen::Vector3d offset = far_offset(middle, extent);
  if (offset.isZero(0.0)) return;  // which leaves every bit of the scene as it is
  move(scene, -offset);
  scene.offset += offset;
}

Bounds in_local_frame(const Bounds& box, const Scene& scene) {
  return {box.low - scene.offset, box.high - scene.offset};
}

Scene in_world(Scene scene) {
  if (scene.offset.isZero(0.0)) return scene;
  move(scene, scene.offset);
  scene.bounds = {scene.bounds.low + scene.offset, scene.bounds.high + scene.offset};
  scene.offset.setZero();
  return scene;
}

}  // namespace quorum
