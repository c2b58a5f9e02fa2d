// COLMAP sparse models, and dense workspaces that COLMAP's image_undistorter prepared, as scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/colmap_model.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The folder of a model and how many images it holds.
struct ColmapModelFolder {
  std::filesystem::path path;
  std::size_t image_count = 0;
  bool is_of_other_program = false;  ///< in a folder in which another program keeps what it asked COLMAP for
};

/// The models that belong to a scene's folder, the largest first: sparse and its subfolders; if these hold none, the
/// folder itself and its subfolders; else colmap/sparse (nerfstudio) and distorted/sparse (Gaussian splatting).
std::vector<ColmapModelFolder> list_colmap_models(const std::filesystem::path& folder);

/// The largest of them; empty if there is none.
std::filesystem::path find_colmap_model(const std::filesystem::path& folder);

/// The lens of a camera of the model, in our pixels: COLMAP's center of the top-left pixel is (0.5, 0.5), ours (0, 0).
Lens lens_of(const ColmapCamera& camera);

/// Reads the scene in folder: the model `chosen`, a folder below it or below its sparse, or if that is empty the
/// largest one (list_colmap_models), and its images, in the folder `images`, or beside the model, or in the folder
/// images where that is given; those of distorted/sparse first in `input`. Views in the order of their names, with the
/// points of the model that they see; images without a photograph are left out. A camera with distortion gives views
/// with a lens, whose camera is that of pinhole_picture. The bounds are left empty. Notes tell what was chosen and left
/// out. Fails (kInput) as read_colmap_model and ViewList do, or if no image is found, or a camera is none.
Expected<Scene> read_colmap(const std::filesystem::path& folder, const std::filesystem::path& images,
                            const std::filesystem::path& chosen = {});

/// The model of views whose pictures have these names: a camera PINHOLE for each view, with its pose, and the points in
/// gray, seen where the views show them. Skew is lost.
ColmapModel colmap_model_of(const std::vector<View>& views, const std::vector<std::string>& names,
                            const std::vector<SparsePoint>& points);

}  // namespace quorum
