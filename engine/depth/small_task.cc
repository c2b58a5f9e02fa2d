#include "engine/depth/small_task.h"

#include <algorithm>
#include <memory>

#include "engine/depth/plane_moves.h"
#include "engine/depth/plane_warp.h"
#include "engine/image/halve.h"

namespace quorum {
namespace {

std::shared_ptr<const PaddedImage> small_image(const PaddedImage& image, int halvings) {
  ColorImage small(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) small.at(x, y) = image.at(x, y);
  for (int i = 0; i < halvings; ++i) small = halve_image(small);
  return std::make_shared<const PaddedImage>(pad_image(small));
}

}  // namespace

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
                          int halvings) {
  SweepTask small;
  small.options = task.options;
  small.options.second_window = 0;
  small.reference = small_image(*task.reference, halvings);
  for (const auto& image : task.neighbors) small.neighbors.push_back(small_image(*image, halvings));
  const Camera camera = small_camera(reference.camera, halvings);
  for (const View* neighbor : neighbors)
    small.warps.push_back(make_plane_warp(camera, small_camera(neighbor->camera, halvings)));
  small.intrinsics = camera.intrinsics;
  small.max_tilt = max_plane_tilt(camera);
  return small;
}

}  // namespace quorum
