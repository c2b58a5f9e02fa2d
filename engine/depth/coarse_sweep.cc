#include "engine/depth/coarse_sweep.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/depth/plane_warp.h"
#include "engine/depth/sweep_depth.h"

namespace quorum {
namespace {

constexpr std::size_t kNeighbors = 6;
constexpr int kMostReferences = 128;
constexpr double kMostPlanes = 512.0;

const View& view_at(const Scene& scene, int index) { return scene.views[static_cast<std::size_t>(index)]; }

/// A view with those that it is compared with, and the planes, whose inverse depths are 1, 2 … times the step.
struct Sweep {
  int reference = 0;
  std::vector<int> neighbors;  ///< ascending by distance
  double step = 0.0;           ///< 1 / scene units
  int planes = 0;
  Grid<float> depth;
};

double distance(const Scene& scene, int a, int b) {
  return (view_at(scene, a).camera.center() - view_at(scene, b).camera.center()).norm();
}

/// Views around the reference that look to about the same side: near ones first, but each apart from those taken.
std::vector<int> choose_neighbors(const Scene& scene, int reference, double least_baseline) {
  constexpr double kLeastCosine = 0.7;
  constexpr double kApart = 0.5;  // of the distance to the reference
  std::vector<std::pair<double, int>> others;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const double cosine =
        view_at(scene, reference).camera.optical_axis().dot(view_at(scene, view).camera.optical_axis());
    const double baseline = distance(scene, reference, view);
    if (baseline > least_baseline && cosine >= kLeastCosine) others.emplace_back(baseline, view);
  }
  std::ranges::sort(others);
  std::vector<int> chosen;
  for (const auto& [baseline, view] : others) {
    if (chosen.size() == kNeighbors) break;
    const bool apart = std::ranges::all_of(chosen, [&, baseline = baseline, view = view](int taken) {
      return distance(scene, taken, view) >= kApart * baseline;
    });
    if (apart) chosen.push_back(view);
  }
  return chosen;
}

Expected<Grid<float>> find_depths(const Scene& scene, const Sweep& sweep, const ImageReader& read) {
  const auto load = [&](int view) -> Expected<std::shared_ptr<const PaddedImage>> {
    QUORUM_ASSIGN(auto image, read(view));
    return std::make_shared<const PaddedImage>(std::move(image));
  };
  const View& view = view_at(scene, sweep.reference);
  SweepTask task;
  task.options.window_model = WindowModel::kPlane;
  task.options.threshold = 0.8F;
  task.options.refinement = 1;
  for (int k = sweep.planes; k >= 1; --k) {
    task.planes.inverse_depth.push_back(static_cast<float>(k * sweep.step));
    task.planes.depth.push_back(static_cast<float>(1.0 / (k * sweep.step)));
  }
  QUORUM_ASSIGN(auto reference, load(sweep.reference));
  task.reference = std::move(reference);
  for (const int neighbor : sweep.neighbors) {
    QUORUM_ASSIGN(auto image, load(neighbor));
    task.neighbors.push_back(std::move(image));
    task.warps.push_back(make_plane_warp(view.camera, view_at(scene, neighbor).camera));
  }
  const int radius = task.options.window / 2;
  task.ranges = Grid<PlaneRange>(view.width, view.height, PlaneRange{1, 0});
  for (int y = radius; y < view.height - radius; ++y)
    for (int x = radius; x < view.width - radius; ++x) task.ranges.at(x, y) = {0, static_cast<uint>(sweep.planes - 1)};
  return sweep_depth(task, {}).depth;
}

/// True if the other view found a depth at the point's projection that is within two of its planes.
bool agrees(const Scene& scene, const Sweep& other, const Eigen::Vector3d& point) {
  constexpr double kPlanes = 2.0;
  const Eigen::Vector3d pixel = view_at(scene, other.reference).camera.project(point);
  const auto x = std::lround(pixel.x());
  const auto y = std::lround(pixel.y());
  if (!(pixel.z() > 0) || x < 0 || y < 0 || x >= other.depth.width || y >= other.depth.height) return false;
  const float depth = other.depth.at(static_cast<int>(x), static_cast<int>(y));
  return depth > 0.0F && std::abs(1.0 / depth - 1.0 / pixel.z()) <= kPlanes * other.step;
}

/// The sweeps that can find something. Baselines below a thousandth of the extent of all centers are none, nor is what
/// rounding makes of a center.
std::vector<Sweep> plan_sweeps(const Scene& scene) {
  constexpr double kRounding = 1e-9;
  const int views = static_cast<int>(scene.views.size());
  double extent = 0.0;
  double magnitude = 0.0;
  for (int view = 0; view < views; ++view) {
    extent = std::max(extent, distance(scene, 0, view));
    magnitude = std::max(magnitude, view_at(scene, view).camera.center().norm());
  }
  if (extent <= kRounding * magnitude) return {};
  std::vector<Sweep> sweeps;
  const int stride = (views + kMostReferences - 1) / kMostReferences;
  for (int reference = 0; reference < views; reference += stride) {
    Sweep sweep{reference, choose_neighbors(scene, reference, 1e-3 * extent), 0.0, 0, {}};
    if (sweep.neighbors.size() < 2) continue;
    const Eigen::Matrix3d& k = view_at(scene, reference).camera.intrinsics;
    const double focal = (k(0, 0) + k(1, 1)) / 2.0;
    const double widest = distance(scene, reference, sweep.neighbors.back());
    const double second = distance(scene, reference, sweep.neighbors[1]);
    sweep.step = 1.0 / (focal * widest);
    sweep.planes =
        static_cast<int>(std::min(kMostPlanes, std::ceil(0.5 * view_at(scene, reference).width * widest / second)));
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace

Expected<std::vector<SparsePoint>> coarse_sweep(const Scene& small, const ImageReader& read) {
  std::vector<Sweep> sweeps = plan_sweeps(small);
  for (Sweep& sweep : sweeps) {
    QUORUM_ASSIGN(auto depth, find_depths(small, sweep, read));
    sweep.depth = std::move(depth);
  }
  constexpr int kPixelStride = 2;
  constexpr double kMostBeyond = 0.5;
  std::vector<SparsePoint> points;
  double found = 0.0;
  double beyond = 0.0;
  for (const Sweep& sweep : sweeps) {
    const Camera& camera = view_at(small, sweep.reference).camera;
    const double farthest = 0.999 / sweep.step;  // what was found on the last plane may be anywhere beyond
    for (int y = 0; y < sweep.depth.height; y += kPixelStride) {
      for (int x = 0; x < sweep.depth.width; x += kPixelStride) {
        const float depth = sweep.depth.at(x, y);
        if (!(depth > 0.0F)) continue;
        found += 1.0;
        if (depth >= farthest) {
          beyond += 1.0;
          continue;
        }
        SparsePoint point{camera.unproject(x, y, depth), {}};
        for (const Sweep& other : sweeps)
          if (&other == &sweep || agrees(small, other, point.position)) point.views.push_back(other.reference);
        if (point.views.size() > 1) points.push_back(std::move(point));
      }
    }
  }
  if (beyond > kMostBeyond * found) points.clear();
  return points;
}

}  // namespace quorum
