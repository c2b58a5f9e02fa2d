// A scene: views with known cameras, and the box that holds the object.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/bounds.h"

namespace quorum {

/// One photograph with its camera. The image stays on disk until a stage needs it.
struct View {
  std::string name;                  ///< unique in the scene; the image's file name without extension
  std::filesystem::path image_path;  ///< the photograph
  std::filesystem::path mask_path;   ///< its mask, or empty
  int width = 0;                     ///< pixels
  int height = 0;                    ///< pixels
  Camera camera;
};

/// Views in the order of their files, and the bounds in scene units.
struct Scene {
  std::vector<View> views;
  Bounds bounds;
};

}  // namespace quorum
