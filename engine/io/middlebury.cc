#include "engine/io/middlebury.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/io/find_extent.h"
#include "engine/io/find_photograph.h"
#include "engine/io/image_size.h"
#include "engine/io/masks.h"
#include "engine/io/par_file.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"
#include "engine/io/view_names.h"
#include "engine/scene/check_bounds.h"
#include "engine/scene/local_frame.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

std::string bounds_remedy() { return "give them with " + option_name("bounds") + " \"x0 y0 z0 x1 y1 z1\""; }

std::string format_point(const Eigen::Vector3d& point) {
  return fmt::format("({:.17g} {:.17g} {:.17g})", point.x(), point.y(), point.z());
}

// --- The cameras

Expected<fs::path> find_par_file(const fs::path& folder) {
  std::error_code code;
  const fs::file_status status = fs::status(folder, code);
  if (!fs::exists(status)) return path_failure(folder, "no such folder; check the path");
  if (!fs::is_directory(status)) return path_failure(folder, "is a file, expected the folder of a scene");

  std::vector<fs::path> found;
  fs::directory_iterator entry(folder, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code))
    if (entry->path().filename().string().ends_with("_par.txt")) found.push_back(entry->path());
  if (code == std::errc::not_enough_memory)
    return failure(ErrorKind::kMemory, folder.string() + ": no memory is left to list it; give the run more");
  if (code) return path_failure(folder, "cannot be listed: " + code.message());
  if (found.empty()) return path_failure(folder, "no *_par.txt with the cameras in this folder");
  if (found.size() == 1) return found.front();
  std::ranges::sort(found);
  std::string names;
  for (const fs::path& path : found) names += (names.empty() ? "" : ", ") + path.filename().string();
  return path_failure(folder, fmt::format("{} par files ({}); leave one of them", found.size(), names));
}

Expected<Scene> read_views(const fs::path& folder, const fs::path& images, const fs::path& par_file) {
  QUORUM_ASSIGN(const auto text, read_file(par_file));
  QUORUM_ASSIGN(const auto lines, parse_par_file(par_file, text));

  Scene scene;
  std::vector<std::string> absent;
  std::map<std::string, int> line_of;
  for (const ParLine& line : lines) {
    View view;
    view.image_name = line.image;
    view.image_path = images.empty() ? find_photograph(folder, line.image) : find_photograph_by_end(images, line.image);
    view.camera = line.camera;
    if (has_control_characters(line.image))
      return failure_at_line(par_file, line.number, "the name of the image has control characters; rename it");
    const auto [other, is_new] = line_of.emplace(view.image_name, line.number);
    if (!is_new)
      return failure_at_line(
          par_file, line.number,
          fmt::format("the name of image {} was taken by line {}", quote_token(line.image), other->second));
    if (view.image_path.empty())
      absent.push_back(line.image);
    else
      scene.views.push_back(std::move(view));
  }
  if (scene.views.size() < 3 && !absent.empty())
    return failure_at_line(par_file, line_of.at(absent.front()),
                           fmt::format("image {} is not in {}; add it, {} of {} are there", quote_token(absent.front()),
                                       (images.empty() ? folder : images).string(), scene.views.size(), lines.size()));
  if (scene.views.size() < 3)
    return path_failure(par_file, fmt::format("holds {} views, expected 3 or more: a reference view and two neighbors",
                                              scene.views.size()));
  if (!absent.empty()) scene.notes.push_back(absent_note(absent, lines.size()));
  QUORUM_TRY(name_views(scene.views));

  std::size_t alpha_count = 0;
  for (View& view : scene.views) {
    QUORUM_ASSIGN(const auto header, read_image_header(view.image_path));
    view.width = header.size.width;
    view.height = header.size.height;
    if (const std::string absurd = absurd_value(view.camera, view.width, view.height); !absurd.empty())
      return failure_at_line(par_file, line_of.at(view.image_name), fmt::format("{}; {}", absurd, kCameraRemedy));
    if (!header.has_alpha) continue;
    view.mask_path = view.image_path;
    ++alpha_count;
  }
  if (alpha_count > 0) scene.notes.push_back(alpha_note(alpha_count));
  return scene;
}

// --- The bounds

bool mentions_bounding_box(std::string_view line) {
  std::string lower(line);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.contains("bounding box");
}

/// A line "(…)" without its parentheses, or nothing.
std::optional<std::string_view> inside_parentheses(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(kTextSpace), line.size()));
  line = line.substr(0, line.find_last_not_of(kTextSpace) + 1);
  if (line.size() < 2 || !line.starts_with('(') || !line.ends_with(')')) return std::nullopt;
  return line.substr(1, line.size() - 2);
}

std::optional<Eigen::Vector3d> parse_point(std::string_view text) {
  const auto tokens = split_tokens(text);
  if (tokens.size() != 3) return std::nullopt;
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = parse_number<double>(tokens[axis]);
    if (!value) return std::nullopt;
    point[axis] = *value;
  }
  return point;
}

/// The first two lines "(x y z)" after the words "bounding box".
Expected<Bounds> read_bounds(const fs::path& readme) {
  QUORUM_ASSIGN(const auto text, read_file(readme));
  LineReader lines(text);
  bool mentioned = false;
  std::vector<Eigen::Vector3d> corners;
  while (const auto line = lines.next()) {
    if (!mentioned) {
      mentioned = mentions_bounding_box(*line);
      continue;
    }
    const auto inside = inside_parentheses(*line);
    if (!inside) continue;
    const auto corner = parse_point(*inside);
    if (!corner)
      return failure_at_line(readme, lines.number(),
                             fmt::format("expected a corner of the bounding box \"(x y z)\", found {}; {}",
                                         quote_token(*line), bounds_remedy()));
    corners.push_back(*corner);
    if (corners.size() == 2) return Bounds{corners[0], corners[1]};
  }
  return path_failure(readme, fmt::format("no \"bounding box\" with two lines \"(x y z)\"; {}", bounds_remedy()));
}

}  // namespace

Expected<Scene> read_middlebury(const fs::path& folder, const std::optional<Bounds>& bounds, const fs::path& masks,
                                const fs::path& images) {
  QUORUM_ASSIGN(const auto par_file, find_par_file(folder));
  QUORUM_ASSIGN(auto scene, read_views(folder, images, par_file));
  if (!masks.empty()) QUORUM_TRY(find_masks(masks, scene.views));
  enter_local_frame(scene);
  const fs::path readme = folder / "README.txt";
  std::error_code ignored;
  if (!bounds && !fs::exists(readme, ignored)) {
    if (const auto found = find_extent(scene); !found) return std::unexpected(found.error().within(folder.string()));
  } else {
    QUORUM_ASSIGN(const auto box, bounds ? *bounds : read_bounds(readme));
    scene.bounds = in_local_frame(box, scene);
  }
  if (const auto checked = check_bounds(scene); !checked)
    return std::unexpected(checked.error().within(folder.string()));
  if (bounds) QUORUM_TRY(find_ranges_inside(scene));
  return scene;
}

Expected<void> write_middlebury(const fs::path& folder, const std::string& name, const Scene& scene) {
  std::vector<ParLine> lines;
  for (const View& view : scene.views) {
    lines.push_back({0, view.image_path.filename().string(), view.camera});
    if (split_tokens(lines.back().image).size() != 1)
      return path_failure(view.image_path, "a par file can't name an image with a space in its name; rename it");
  }
  QUORUM_TRY(write_file(folder / (name + "_par.txt"), format_par_file(lines)));
  return write_file(folder / "README.txt",
                    fmt::format("{}: {} views\nThe (tight) bounding box is\n{}\n{}\n", name, scene.views.size(),
                                format_point(scene.bounds.low), format_point(scene.bounds.high)));
}

}  // namespace quorum
