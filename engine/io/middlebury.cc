#include "engine/io/middlebury.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/masks.h"
#include "engine/io/par_file.h"
#include "engine/io/text.h"
#include "engine/scene/check_bounds.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBoundsRemedy = "give them with --bounds \"x0 y0 z0 x1 y1 z1\"";

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
  if (code) return path_failure(folder, "cannot be listed: " + code.message());
  if (found.empty()) return path_failure(folder, "no *_par.txt with the cameras in this folder");
  if (found.size() == 1) return found.front();
  std::ranges::sort(found);
  std::string names;
  for (const fs::path& path : found) names += (names.empty() ? "" : ", ") + path.filename().string();
  return path_failure(folder, fmt::format("{} par files ({}); leave one of them", found.size(), names));
}

Expected<std::vector<View>> read_views(const fs::path& folder, const fs::path& par_file) {
  const auto text = read_file(par_file);
  if (!text) return std::unexpected(text.error());
  const auto lines = parse_par_file(par_file, *text);
  if (!lines) return std::unexpected(lines.error());

  std::vector<View> views;
  std::map<std::string, int> line_of;
  for (const ParLine& line : *lines) {
    View view;
    view.image_name = line.image;
    view.image_path = folder / line.image;
    view.name = view.image_path.stem().string();
    view.camera = line.camera;
    const auto [other, is_new] = line_of.emplace(view.name, line.number);
    if (!is_new)
      return failure_at_line(
          par_file, line.number,
          fmt::format("the name of image {} was taken by line {}", quote_token(line.image), other->second));
    std::error_code ignored;
    if (!fs::is_regular_file(view.image_path, ignored))
      return failure_at_line(par_file, line.number,
                             fmt::format("image {} is not in {}; add it or remove the line and lower the count",
                                         quote_token(line.image), folder.string()));
    views.push_back(std::move(view));
  }
  if (views.size() < 3)
    return path_failure(
        par_file, fmt::format("holds {} views, expected 3 or more: a reference view and two neighbors", views.size()));

  const auto first = read_image(views.front().image_path);
  if (!first) return std::unexpected(first.error());
  for (View& view : views) {
    view.width = first->width;
    view.height = first->height;
  }
  return views;
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
  std::error_code ignored;
  if (!fs::exists(readme, ignored)) return path_failure(readme, fmt::format("no file with bounds; {}", kBoundsRemedy));
  const auto text = read_file(readme);
  if (!text) return std::unexpected(text.error());
  LineReader lines(*text);
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
                                         quote_token(*line), kBoundsRemedy));
    corners.push_back(*corner);
    if (corners.size() == 2) return Bounds{corners[0], corners[1]};
  }
  return path_failure(readme, fmt::format("no \"bounding box\" with two lines \"(x y z)\"; {}", kBoundsRemedy));
}

}  // namespace

Expected<Scene> read_middlebury(const fs::path& folder, const std::optional<Bounds>& bounds, const fs::path& masks) {
  const auto par_file = find_par_file(folder);
  if (!par_file) return std::unexpected(par_file.error());
  auto views = read_views(folder, *par_file);
  if (!views) return std::unexpected(views.error());
  Scene scene{std::move(*views), {}};
  if (!masks.empty())
    if (const auto found = find_masks(masks, scene.views); !found) return std::unexpected(found.error());
  const auto box = bounds ? *bounds : read_bounds(folder / "README.txt");
  if (!box) return std::unexpected(box.error());
  scene.bounds = *box;
  if (const auto checked = check_bounds(scene); !checked)
    return std::unexpected(checked.error().within(folder.string()));
  return scene;
}

Expected<void> write_middlebury(const fs::path& folder, const std::string& name, const Scene& scene) {
  std::vector<ParLine> lines;
  for (const View& view : scene.views) {
    lines.push_back({0, view.image_path.filename().string(), view.camera});
    if (split_tokens(lines.back().image).size() != 1)
      return path_failure(view.image_path, "a par file can't name an image with a space in its name; rename it");
  }
  if (const auto written = write_file(folder / (name + "_par.txt"), format_par_file(lines)); !written) return written;
  return write_file(folder / "README.txt",
                    fmt::format("{}: {} views\nThe (tight) bounding box is\n{}\n{}\n", name, scene.views.size(),
                                format_point(scene.bounds.low), format_point(scene.bounds.high)));
}

}  // namespace quorum
