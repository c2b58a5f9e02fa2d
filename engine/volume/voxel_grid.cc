#include "engine/volume/voxel_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/option.h"
#include "engine/scene/parallax.h"

namespace quorum {
namespace {

/// Side of a pixel at a point; 0 behind the camera.
double footprint(const Camera& camera, const Eigen::Vector3d& point) {
  return std::max(0.0, 2.0 * camera.to_camera(point).z() / (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)));
}

bool holds(const Bounds& box, const Eigen::Vector3d& point) {
  return (point.array() >= box.low.array()).all() && (point.array() <= box.high.array()).all();
}

/// In the middle of all views of all points within the bounds; without points, at the center of the bounds; and if a
/// camera stands inside of them, of points on the rays of all views.
double median_footprint(const Scene& scene) {
  std::vector<double> footprints;
  const auto add = [&footprints](const Camera& camera, const Eigen::Vector3d& point) {
    if (const double side = footprint(camera, point); side > 0) footprints.push_back(side);
  };
  for (const SparsePoint& point : scene.points)
    if (holds(scene.bounds, point.position))
      for (const int view : point.views) add(scene.views[static_cast<std::size_t>(view)].camera, point.position);
  const bool inside =
      std::ranges::any_of(scene.views, [&](const View& view) { return holds(scene.bounds, view.camera.center()); });
  if (footprints.empty() && inside)
    for (const View& view : scene.views)
      for (const RayPoint& point : sample_rays(view, scene.bounds)) add(view.camera, point.position);
  if (footprints.empty())
    for (const View& view : scene.views) add(view.camera, scene.bounds.center());
  if (footprints.empty()) return 0.0;
  const auto middle = footprints.begin() + static_cast<std::ptrdiff_t>(footprints.size() / 2);
  std::nth_element(footprints.begin(), middle, footprints.end());
  return *middle;
}

constexpr double kMaxBlocks = 1 << 30;

/// Lays blocks of the grid's voxels over the bounds and a margin. How many; not all where they are more than
/// kMaxBlocks.
double lay_blocks(const Scene& scene, VoxelGrid& grid) {
  const Bounds bounds = scene.bounds.expanded(grid.truncation + grid.voxel_size);
  grid.origin = bounds.low;
  double blocks = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::ceil(bounds.size()(axis) / (grid.voxel_size * kBlockSide));
    blocks *= count;
    grid.blocks[static_cast<std::size_t>(axis)] = static_cast<int>(std::min(count, kMaxBlocks));
  }
  return blocks;
}

}  // namespace

Expected<VoxelGrid> make_voxel_grid(const Scene& scene, const FusionOptions& options) {
  constexpr double kCoarser = 1.25;
  const bool automatic = !(options.voxel_size > 0);
  const double wanted = automatic ? median_footprint(scene) : options.voxel_size;
  VoxelGrid grid;
  grid.voxel_size = wanted;
  if (!(grid.voxel_size > 0))
    return failure(ErrorKind::kInput,
                   "the center of the bounds lies behind every camera; check " + option_name("bounds"));
  const double truncation_in_voxels = options.signed_distance == SignedDistance::kNormal ? 3.0 : 4.0;
  double blocks = 0.0;
  for (;; grid.voxel_size *= kCoarser) {
    grid.truncation = options.truncation > 0 ? options.truncation : truncation_in_voxels * grid.voxel_size;
    blocks = lay_blocks(scene, grid);
    if (blocks <= kMaxBlocks || !automatic || !std::isfinite(grid.voxel_size)) break;
  }
  grid.is_coarse = grid.voxel_size > wanted;
  if (grid.truncation < 1.5 * grid.voxel_size || grid.truncation > 32 * grid.voxel_size)
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give 1.5 to 32 times the voxel size {}",
                                                  option_name("truncation"), grid.truncation, grid.voxel_size));
  if (!(blocks <= kMaxBlocks))
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: the bounds would hold {:.3g} blocks of 8x8x8 voxels, more than {:.0f}; "
                               "give a larger voxel or smaller bounds",
                               option_name("voxel-size"), grid.voxel_size, blocks, kMaxBlocks));
  return grid;
}

}  // namespace quorum
