// COLMAP sparse models, and dense workspaces that COLMAP's image_undistorter prepared, as scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/colmap_model.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The folder of the model that belongs to a scene's folder: sparse, sparse/0, the folder itself, or the only one of
/// its subfolders that holds a model. Empty if there is none.
std::filesystem::path find_colmap_model(const std::filesystem::path& folder);

/// The lens of a camera of the model, in our pixels: COLMAP's center of the top-left pixel is (0.5, 0.5), ours (0, 0).
Lens lens_of(const ColmapCamera& camera);

/// Reads the scene in folder: the model (find_colmap_model) and its images, in the folder `images`, or beside the
/// model, or in the folder images where that is given. Views in the order of their names, with all points of the model.
/// A camera with distortion gives views with a lens, whose camera is that of pinhole_picture. The bounds are left
/// empty. Fails (kInput) as read_colmap_model does, if there are fewer than three images, or one is absent, or a camera
/// is none or has another size than its image.
Expected<Scene> read_colmap(const std::filesystem::path& folder, const std::filesystem::path& images);

/// The model of views whose pictures have these names: a camera PINHOLE for each view, with its pose, and the points in
/// gray, seen where the views show them. Skew is lost.
ColmapModel colmap_model_of(const std::vector<View>& views, const std::vector<std::string>& names,
                            const std::vector<SparsePoint>& points);

}  // namespace quorum
