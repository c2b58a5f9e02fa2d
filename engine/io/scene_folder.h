// Scenes of all formats that are read: which one a folder holds, and what is common to reading them.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/bounds.h"
#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// kAutomatic: what the folder shows.
enum class SceneFormat {
  kAutomatic,
  kMiddlebury,
  kColmap,
  kTransforms,
  kMvsnet,
  kBundler,
  kOpenMvg,
  kOpenSfm,
  kMeshroom,
  kMetashape,
  kRealityCapture,
  kVisualSfm
};

/// The formats under the names that --format takes, "auto" first.
std::vector<std::pair<std::string_view, SceneFormat>> scene_format_names();

struct SceneOptions {
  SceneFormat format = SceneFormat::kAutomatic;
  std::optional<Bounds> bounds;  ///< instead of those of the files, or found (find_bounds)
  std::filesystem::path roi;     ///< or those of this file (read_roi); empty = none
  std::filesystem::path masks;   ///< folder with a mask for each image (find_masks); empty = none
  std::filesystem::path images;  ///< folder of the photographs, where it is not beside the cameras; empty = look there
  std::filesystem::path model;  ///< of several in a COLMAP scene the one to read, such as sparse/1; empty = the largest
  int max_image_size = 0;       ///< photographs that are wider or higher are halved until they are not; 0 = keep all
};

/// The format of the scene in a folder: Middlebury if it holds a *_par.txt, COLMAP if it holds a model
/// (find_colmap_model), nerfstudio if it holds transforms.json, MVSNet if it holds a folder cams, Bundler if it holds a
/// bundle (find_bundle), or the first of sfm_formats() that it holds a file of, in this order. Fails (kInput) if it is
/// no folder, or holds none of them.
Expected<SceneFormat> recognize_format(const std::filesystem::path& folder);

/// A box from a file: that of the vertices of a .ply file, or the six numbers x0 y0 z0 x1 y1 z1 of a text, in which
/// lines with # are comments. Fails (kInput).
Expected<Bounds> read_roi(const std::filesystem::path& path);

/// Reads the scene in a folder with its masks and bounds. A COLMAP workspace may hold stereo/patch-match.cfg, which
/// gives the neighbors. Views have a depth range (find_depth_ranges) unless the bounds were given and don't hold their
/// camera. Fails (kInput) as the reader of the format does, as find_masks and find_bounds do, if the bounds are empty
/// or no view sees them, and (kUsage) if both bounds and roi are given, or max_image_size is below 16.
Expected<Scene> read_scene(const std::filesystem::path& folder, const SceneOptions& options);

/// What read_scene does with what a reader gives, for views that no file describes: named (name_views), with
/// photographs, cameras, points and masks in world coordinates. Of the options the format, images and model are not
/// looked at. Fails as read_scene does after reading.
Expected<Scene> complete_scene(Scene scene, const SceneOptions& options);

}  // namespace quorum
