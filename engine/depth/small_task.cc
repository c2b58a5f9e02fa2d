#include "engine/depth/small_task.h"

#include <algorithm>

#include "engine/depth/plane_moves.h"
#include "engine/depth/plane_warp.h"

namespace quorum {
bool has_small_images(const SweepTask& task) {
  constexpr int kLeastSide = 64;
  return task.options.is_slanted() && std::min(task.ranges.width, task.ranges.height) >= kLeastSide;
}

Camera small_camera(Camera camera, int halvings) {
  Eigen::Matrix3d half;
  half << 0.5, 0.0, -0.25, 0.0, 0.5, -0.25, 0.0, 0.0, 1.0;
  for (int i = 0; i < halvings; ++i) camera.intrinsics = half * camera.intrinsics;
  return camera;
}

SweepTask make_small_task(const SweepTask& task, const View& reference, const std::vector<const View*>& neighbors,
                          int halvings, SmallImages& images) {
  SweepTask small;
  small.options = task.options;
  small.options.second_window = 0;
  small.reference = images.of(task.reference, halvings);
  for (const auto& image : task.neighbors) small.neighbors.push_back(images.of(image, halvings));
  const Camera camera = small_camera(reference.camera, halvings);
  for (const View* neighbor : neighbors)
    small.warps.push_back(make_plane_warp(camera, small_camera(neighbor->camera, halvings)));
  small.intrinsics = camera.intrinsics;
  small.max_tilt = max_plane_tilt(camera);
  return small;
}

}  // namespace quorum
