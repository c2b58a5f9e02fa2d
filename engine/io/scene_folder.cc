#include "engine/io/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <system_error>

#include "engine/core/option.h"
#include "engine/core/printable.h"
#include "engine/io/bundler.h"
#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "engine/io/find_extent.h"
#include "engine/io/image_file.h"
#include "engine/io/image_size.h"
#include "engine/io/jpeg_flaw.h"
#include "engine/io/masks.h"
#include "engine/io/middlebury.h"
#include "engine/io/mvsnet.h"
#include "engine/io/patch_match_cfg.h"
#include "engine/io/ply.h"
#include "engine/io/sfm_formats.h"
#include "engine/io/text.h"
#include "engine/io/transforms.h"
#include "engine/io/view_list.h"
#include "engine/scene/check_bounds.h"
#include "engine/scene/copies.h"
#include "engine/scene/limit_image_size.h"
#include "engine/scene/local_frame.h"
#include "engine/scene/scene_bounds.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

bool holds_file_that_ends_with(const fs::path& folder, std::string_view ending) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code))
    if (entry->path().filename().string().ends_with(ending)) return true;
  if (code == std::errc::not_enough_memory) throw std::bad_alloc();
  return false;
}

/// The box of a mesh or cloud.
Expected<Bounds> box_of_ply(const fs::path& path) {
  QUORUM_ASSIGN(const auto mesh, read_ply(path));
  if (mesh.vertices.empty()) return path_failure(path, "holds no vertex; draw a box or a piece of the object");
  Eigen::Vector3f low = mesh.vertices[0].position;
  Eigen::Vector3f high = low;
  for (const Vertex& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex.position);
    high = high.cwiseMax(vertex.position);
  }
  return Bounds{low.cast<double>() + mesh.offset, high.cast<double>() + mesh.offset};
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
Expected<Scene> read_format(SceneFormat format, const fs::path& folder, const SceneOptions& options) {
  if (format == SceneFormat::kTransforms) return read_transforms(folder, options.images);
  if (format == SceneFormat::kMvsnet) return read_mvsnet(folder, options.images);
  if (format == SceneFormat::kBundler) return read_bundler(folder, options.images);
  for (const SfmFormat& other : sfm_formats())
    if (other.format == format) return read_sfm_format(other, folder, options.images);
  auto scene = read_colmap(folder, options.images, options.model);
  const fs::path pairs = folder / "stereo" / "patch-match.cfg";
  std::error_code ignored;
  if (scene && fs::exists(pairs, ignored)) {
    QUORUM_ASSIGN(const auto unknown, read_patch_match_cfg(pairs, scene->views));
    if (unknown > 0)
      scene->notes.push_back(
          fmt::format("patch-match.cfg: {} names of images that are not in the scene are left out", unknown));
  }
  return scene;
}

/// Files with more than 8 bits a channel are taken by the range of their values; which one that is, of the first view.
/// A huge one is not decoded for that, since no budget of memory is asked yet.
Expected<void> note_pixel_range(Scene& scene) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;
  QUORUM_ASSIGN(const auto header, read_image_header(scene.views.front().image_path));
  if (header.bits <= 8 || decoded_bytes(header) > kMostBytes) return {};
  QUORUM_ASSIGN(const auto range, describe_pixel_range(scene.views.front().image_path));
  if (!range.empty()) scene.notes.push_back(range);
  return {};
}

/// JPEG files that lack nothing but the marker of their end are taken, and told.
Expected<void> note_missing_ends(Scene& scene) {
  std::vector<std::string> names;
  for (const View& view : scene.views) {
    QUORUM_ASSIGN(const bool lacks_end, is_jpeg_without_end(view.image_path));
    if (lacks_end) names.push_back(view.image_name);
  }
  if (!names.empty())
    scene.notes.push_back(
        fmt::format("{} photographs lack the marker of a JPEG file's end, and are whole without it: {}", names.size(),
                    names_in_short(names)));
  return {};
}

/// Masks, frame, bounds and depth ranges of a scene as a reader gives it. where: what messages call it.
Expected<void> place_scene(Scene& scene, const SceneOptions& options, const std::optional<Bounds>& given,
                           const std::string& where) {
  if (!options.masks.empty()) QUORUM_TRY(find_masks(options.masks, scene.views));
  enter_local_frame(scene);
  if (given) scene.bounds = in_local_frame(*given, scene);
  if (auto found = given ? Expected<void>() : find_extent(scene); !found)
    return std::unexpected(found.error().within(where));
  if (auto checked = check_bounds(scene); !checked) return std::unexpected(checked.error().within(where));
  limit_depths(scene, given.has_value());
  return given ? find_ranges_inside(scene) : Expected<void>();
}

/// The scene with masks, bounds and depth ranges, at the full size of its photographs.
Expected<Scene> read_views(const fs::path& folder, const SceneOptions& options, const std::optional<Bounds>& given) {
  SceneFormat format = options.format;
  if (format == SceneFormat::kAutomatic) {
    QUORUM_ASSIGN(const auto found, recognize_format(folder));
    format = found;
  }
  if (!options.model.empty() && format != SceneFormat::kColmap)
    return failure(ErrorKind::kUsage, option_name("model") + ": only COLMAP's scenes have several; leave it out");
  if (format == SceneFormat::kMiddlebury) return read_middlebury(folder, given, options.masks, options.images);

  auto scene = read_format(format, folder, options);
  if (scene) QUORUM_TRY(place_scene(*scene, options, given, folder.string()));
  return scene;
}

/// The box that the options give, after they were checked.
Expected<std::optional<Bounds>> given_bounds(const SceneOptions& options) {
  if (options.bounds && !options.roi.empty())
    return failure(ErrorKind::kUsage, option_name("roi") + ": give it or " + option_name("bounds") + ", not both");
  if (options.max_image_size != 0 && options.max_image_size < 16)
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give 16 pixels or more, or 0", option_name("max-image-size"),
                                                  options.max_image_size));
  if (options.roi.empty()) return options.bounds;
  QUORUM_ASSIGN(auto box, read_roi(options.roi));
  return box;
}

/// What is left once the views have their places.
Expected<void> end_reading(Scene& scene, const SceneOptions& options) {
  QUORUM_TRY(note_missing_ends(scene));
  QUORUM_TRY(note_pixel_range(scene));
  for (std::string& note : scene.notes) note = printable(note);
  if (options.max_image_size > 0) limit_image_size(scene, options.max_image_size);
  mark_copies(scene);
  return {};
}

}  // namespace

std::vector<std::pair<std::string_view, SceneFormat>> scene_format_names() {
  std::vector<std::pair<std::string_view, SceneFormat>> names = {
      {"auto", SceneFormat::kAutomatic}, {"middlebury", SceneFormat::kMiddlebury},
      {"colmap", SceneFormat::kColmap},  {"transforms", SceneFormat::kTransforms},
      {"mvsnet", SceneFormat::kMvsnet},  {"bundler", SceneFormat::kBundler}};
  for (const SfmFormat& format : sfm_formats()) names.emplace_back(format.name, format.format);
  return names;
}

Expected<SceneFormat> recognize_format(const fs::path& folder) {
  std::error_code ignored;
  const fs::file_status status = fs::status(folder, ignored);
  if (!fs::exists(status)) return path_failure(folder, "no such folder; check the path");
  if (!fs::is_directory(status)) return path_failure(folder, "is a file, expected the folder of a scene");
  if (holds_file_that_ends_with(folder, "_par.txt")) return SceneFormat::kMiddlebury;
  const bool has_transforms = fs::is_regular_file(folder / "transforms.json", ignored);
  const auto models = list_colmap_models(folder);
  if (!models.empty() && !(has_transforms && models.front().is_of_other_program)) return SceneFormat::kColmap;
  if (has_transforms) return SceneFormat::kTransforms;
  if (fs::is_directory(folder / "cams", ignored)) return SceneFormat::kMvsnet;
  if (!find_bundle(folder).empty()) return SceneFormat::kBundler;
  for (const SfmFormat& format : sfm_formats())
    if (!format.find(folder).empty()) return format.format;
  std::string missing =
      "no cameras in this folder: no *_par.txt (Middlebury), sparse model (COLMAP), transforms.json (nerfstudio), cams "
      "(MVSNet), bundle.out (Bundler)";
  for (const SfmFormat& format : sfm_formats()) missing += fmt::format(", {}", format.files);
  if (const std::string unread = unread_cameras(folder); !unread.empty())
    return path_failure(folder, missing + "; " + unread);
  for (const char* extension : {".jpg", ".JPG", ".jpeg", ".png", ".tif", ".heic", ".HEIC", ".avif"})
    if (holds_file_that_ends_with(folder, extension))
      return path_failure(folder, missing + "; quorum photos finds the cameras of plain photographs");
  return path_failure(folder, missing);
}

Expected<Bounds> read_roi(const fs::path& path) {
  if (path.extension() == ".ply") return box_of_ply(path);
  QUORUM_ASSIGN(const auto text, read_file(path));
  std::vector<double> numbers;
  LineReader lines(text);
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
  QUORUM_ASSIGN(const auto given, given_bounds(options));
  auto scene = read_views(folder, options, given);
  if (scene) QUORUM_TRY(end_reading(*scene, options));
  return scene;
}

Expected<Scene> complete_scene(Scene scene, const SceneOptions& options) {
  QUORUM_ASSIGN(const auto given, given_bounds(options));
  QUORUM_TRY(place_scene(scene, options, given, "scene"));
  QUORUM_TRY(end_reading(scene, options));
  return scene;
}

}  // namespace quorum
