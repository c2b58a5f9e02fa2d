// What files of programs for structure from motion say, before photographs are looked at; and the scene that it makes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/image_size.h"
#include "engine/scene/scene.h"

namespace quorum {

/// An image that has a camera.
struct SfmImage {
  std::string name;  ///< of the photograph, or its path
  Camera pose;       ///< its intrinsics are ignored
  /// The lens, for a photograph of this size; width and height are 0 if the files don't say for which size it is.
  std::function<Lens(ImageSize)> lens;
};

struct SfmModel {
  std::filesystem::path file;            ///< that says it
  std::vector<SfmImage> images = {};     ///< in any order
  std::size_t placeless = 0;             ///< images without a camera, which are left out
  std::vector<SparsePoint> points = {};  ///< views: indices of images
  std::vector<std::string> notes = {};
};

/// A lens that holds for whatever size the photograph has.
std::function<Lens(ImageSize)> fixed_lens(const Lens& lens);

/// The scene, views in the order of their names. folders: where photographs may stand, the best first. Fails (kInput)
/// as ViewList does.
Expected<Scene> make_sfm_scene(SfmModel model, const std::vector<std::filesystem::path>& folders);

/// Where photographs may stand: given alone, if it is not empty; else beside the file, in images beside it, and the
/// same one and two folders up.
std::vector<std::filesystem::path> photograph_folders(const std::filesystem::path& file,
                                                      const std::filesystem::path& given);

/// Gives points the views before which they lie, where no more is known of who sees them, and drops those that lie
/// before none. At most some 20,000 are kept.
std::vector<SparsePoint> points_before(const std::vector<View>& views, const std::vector<Eigen::Vector3d>& positions);

}  // namespace quorum
