// A scene: views with known cameras, sparse points that they see, and the box that holds the object.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/camera/lens.h"
#include "engine/core/bounds.h"

namespace quorum {

/// One photograph with its camera. The image stays on disk until a stage needs it.
struct View {
  std::string name;                  ///< unique in the scene; names the view's files
  std::string image_name = {};       ///< what the scene's files call the photograph: a label, never a path to write to
  std::filesystem::path image_path;  ///< the photograph
  std::filesystem::path mask_path;   ///< its mask, or the photograph itself: its alpha channel; or empty
  int width = 0;                     ///< pixels, of the image that the stages work on
  int height = 0;                    ///< pixels
  Camera camera;                     ///< of that image
  std::optional<Lens> lens = {};     ///< of the photograph, if it has to be undistorted to become that image
  int photo_width = 0;               ///< pixels of the photograph; 0 = those of the image
  int photo_height = 0;
  int halvings = 0;                  ///< of the photograph, undistorted, to become that image
  double near_depth = 0.0;           ///< least depth to look at, scene units
  double far_depth = 0.0;            ///< largest depth to look at; 0 = the bounds alone say
  std::vector<int> neighbors = {};   ///< to compare with, best first, if the scene's files name them
  std::optional<bool> is_copy = {};  ///< what is_copy() says; empty = not looked at yet (mark_copies)
};

/// A point of the object that several views see.
struct SparsePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world, scene units
  std::vector<int> views;                              ///< that see it, ascending, each once
};

/// Views in the order of their files, the bounds in scene units, and what is known of the surface beforehand. "World"
/// is the scene's frame, in which its files' origin may lie far off.
struct Scene {
  std::vector<View> views;
  Bounds bounds;
  std::vector<SparsePoint> points = {};              ///< may be empty
  std::vector<std::string> notes = {};               ///< lines for the user: what was left out, and what was chosen
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< files' coordinates = these + offset (local_frame.h)
};

}  // namespace quorum
