#include "engine/scene/limit_image_size.h"

#include <algorithm>

namespace quorum {

void limit_image_size(Scene& scene, int max_size) {
  for (View& view : scene.views) {
    if (view.photo_width == 0) {
      view.photo_width = view.width;
      view.photo_height = view.height;
    }
    while (std::max(view.width, view.height) > max_size) {
      // The center of a new pixel is the corner of four old ones.
      Eigen::Matrix3d half;
      half << 0.5, 0.0, -0.25, 0.0, 0.5, -0.25, 0.0, 0.0, 1.0;
      view.camera.intrinsics = half * view.camera.intrinsics;
      view.width /= 2;
      view.height /= 2;
      ++view.halvings;
    }
  }
}

}  // namespace quorum
