// What all readers of cameras do with a photograph: check it, name it, undistort it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Collects the views of a scene.
class ViewList {
 public:
  /// Adds a photograph. image_name: its path below the folder of images. pose: its intrinsics are ignored. lens: of the
  /// photograph; the view gets its pinhole picture. A lens without distortion gives a view as it is; where its width
  /// and height are 0 they are taken from the photograph. Fails (kInput) if the photograph is absent or has another
  /// size than the lens, or if the lens is none.
  Expected<void> add(const std::string& image_name, const std::filesystem::path& image_path, const Camera& pose,
                     Lens lens);

  /// The views under their names: the name of the image without extension, "/" replaced by "_"; with it where two would
  /// be the same. Fails (kInput) if there are fewer than three views, or two of one image.
  Expected<std::vector<View>> finish();

 private:
  std::vector<View> views_;
};

}  // namespace quorum
