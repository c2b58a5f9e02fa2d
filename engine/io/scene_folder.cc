#include "engine/io/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "engine/io/bundler.h"
#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "engine/io/masks.h"
#include "engine/io/middlebury.h"
#include "engine/io/mvsnet.h"
#include "engine/io/patch_match_cfg.h"
#include "engine/io/ply.h"
#include "engine/io/text.h"
#include "engine/io/transforms.h"
#include "engine/scene/check_bounds.h"
#include "engine/scene/limit_image_size.h"
#include "engine/scene/scene_bounds.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

bool holds_file_that_ends_with(const fs::path& folder, std::string_view ending) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code))
    if (entry->path().filename().string().ends_with(ending)) return true;
  return false;
}

/// The box of a mesh or cloud.
Expected<Bounds> box_of_ply(const fs::path& path) {
  const auto mesh = read_ply(path);
  if (!mesh) return std::unexpected(mesh.error());
  if (mesh->vertices.empty()) return path_failure(path, "holds no vertex; draw a box or a piece of the object");
  Bounds box{mesh->vertices[0].position.cast<double>(), mesh->vertices[0].position.cast<double>()};
  for (const Vertex& vertex : mesh->vertices) {
    box.low = box.low.cwiseMin(vertex.position.cast<double>());
    box.high = box.high.cwiseMax(vertex.position.cast<double>());
  }
  return box;
}

/// Whoever gives a box wants all of it, so depths are limited otherwise only where a camera stands in the box.
void limit_depths(Scene& scene, bool bounds_given) {
  find_depth_ranges(scene);
  if (!bounds_given) return;
  for (View& view : scene.views) {
    const Eigen::Vector3d center = view.camera.center();
    const bool inside =
        (center.array() >= scene.bounds.low.array()).all() && (center.array() <= scene.bounds.high.array()).all();
    if (inside) continue;
    view.near_depth = 0.0;
    view.far_depth = 0.0;
  }
}

/// The readers of formats that know no bounds.
Expected<Scene> read_format(SceneFormat format, const fs::path& folder, const fs::path& images) {
  if (format == SceneFormat::kTransforms) return read_transforms(folder, images);
  if (format == SceneFormat::kMvsnet) return read_mvsnet(folder, images);
  if (format == SceneFormat::kBundler) return read_bundler(folder, images);
  auto scene = read_colmap(folder, images);
  const fs::path pairs = folder / "stereo" / "patch-match.cfg";
  std::error_code ignored;
  if (scene && fs::exists(pairs, ignored))
    if (auto read = read_patch_match_cfg(pairs, scene->views); !read) return std::unexpected(read.error());
  return scene;
}

/// The scene with masks, bounds and depth ranges, at the full size of its photographs.
Expected<Scene> read_views(const fs::path& folder, const SceneOptions& options, const std::optional<Bounds>& given) {
  SceneFormat format = options.format;
  if (format == SceneFormat::kAutomatic) {
    const auto found = recognize_format(folder);
    if (!found) return std::unexpected(found.error());
    format = *found;
  }
  if (format == SceneFormat::kMiddlebury) return read_middlebury(folder, given, options.masks);

  auto scene = read_format(format, folder, options.images);
  if (!scene) return scene;
  if (!options.masks.empty())
    if (auto found = find_masks(options.masks, scene->views); !found) return std::unexpected(found.error());
  const auto bounds = given ? *given : find_bounds(*scene);
  if (!bounds) return std::unexpected(bounds.error().within(folder.string()));
  scene->bounds = *bounds;
  if (auto checked = check_bounds(*scene); !checked) return std::unexpected(checked.error().within(folder.string()));
  limit_depths(*scene, given.has_value());
  return scene;
}

}  // namespace

std::vector<std::pair<std::string_view, SceneFormat>> scene_format_names() {
  return {{"auto", SceneFormat::kAutomatic}, {"middlebury", SceneFormat::kMiddlebury},
          {"colmap", SceneFormat::kColmap},  {"transforms", SceneFormat::kTransforms},
          {"mvsnet", SceneFormat::kMvsnet},  {"bundler", SceneFormat::kBundler}};
}

Expected<SceneFormat> recognize_format(const fs::path& folder) {
  std::error_code ignored;
  const fs::file_status status = fs::status(folder, ignored);
  if (!fs::exists(status)) return path_failure(folder, "no such folder; check the path");
  if (!fs::is_directory(status)) return path_failure(folder, "is a file, expected the folder of a scene");
  if (holds_file_that_ends_with(folder, "_par.txt")) return SceneFormat::kMiddlebury;
  if (!find_colmap_model(folder).empty()) return SceneFormat::kColmap;
  if (fs::is_regular_file(folder / "transforms.json", ignored)) return SceneFormat::kTransforms;
  if (fs::is_directory(folder / "cams", ignored)) return SceneFormat::kMvsnet;
  if (!find_bundle(folder).empty()) return SceneFormat::kBundler;
  return path_failure(folder,
                      "no cameras in this folder: no *_par.txt (Middlebury), sparse model (COLMAP), transforms.json "
                      "(nerfstudio), cams (MVSNet) or bundle.out (Bundler)");
}

Expected<Bounds> read_roi(const fs::path& path) {
  if (path.extension() == ".ply") return box_of_ply(path);
  const auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  std::vector<double> numbers;
  LineReader lines(*text);
  while (const auto line = lines.next()) {
    for (const std::string_view token : split_tokens(line->substr(0, line->find('#')))) {
      const auto number = parse_number<double>(token);
      if (!number) return failure_at_line(path, lines.number(), quote_token(token) + " is not a number");
      numbers.push_back(*number);
    }
  }
  if (numbers.size() != 6)
    return path_failure(path, fmt::format("expected six numbers x0 y0 z0 x1 y1 z1, found {}", numbers.size()));
  return Bounds{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

Expected<Scene> read_scene(const fs::path& folder, const SceneOptions& options) {
  if (options.bounds && !options.roi.empty()) return failure(ErrorKind::kUsage, "--roi: give either --bounds or --roi");
  if (options.max_image_size != 0 && options.max_image_size < 16)
    return failure(ErrorKind::kUsage,
                   fmt::format("--max-image-size {}: give 16 pixels or more, or 0", options.max_image_size));
  std::optional<Bounds> given = options.bounds;
  if (!options.roi.empty()) {
    const auto box = read_roi(options.roi);
    if (!box) return std::unexpected(box.error());
    given = *box;
  }
  auto scene = read_views(folder, options, given);
  if (!scene) return scene;
  if (options.max_image_size > 0) limit_image_size(*scene, options.max_image_size);
  return scene;
}

}  // namespace quorum
