#include "engine/io/mvsnet.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"
#include "engine/io/word_reader.h"
#include "engine/scene/select_views.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCameraEnding = "_cam.txt";
constexpr double kUsualDepths = 192;

struct MvsnetCamera {
  Camera camera;
  double near_depth = 0.0;
  double far_depth = 0.0;
};

Expected<MvsnetCamera> parse_camera(const fs::path& path, std::string_view text) {
  WordReader words(path, text);
  MvsnetCamera result;
  words.expect("extrinsic");
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const auto value = words.number<double>("a value of the extrinsic matrix");
      if (row == 3 && value != (column == 3 ? 1.0 : 0.0))
        words.fail("the last row of the extrinsic matrix is not 0 0 0 1");
      if (row == 3) continue;
      (column < 3 ? result.camera.camera_from_world(row, column) : result.camera.translation(row)) = value;
    }
  }
  words.expect("intrinsic");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result.camera.intrinsics(row, column) = words.number<double>("a value of the intrinsic matrix");
  result.near_depth = words.number<double>("depth_min");
  const auto interval = words.number<double>("the depth interval");
  const double count = !words.at_end() ? words.number<double>("the count of depths") : kUsualDepths;
  result.far_depth = !words.at_end() ? words.number<double>("depth_max") : result.near_depth + (count - 1.0) * interval;
  if (!(result.near_depth > 0 && result.far_depth > result.near_depth && result.far_depth < 1e30))
    words.fail("depth_min, interval, count and depth_max give no range of depths");
  if (!words.at_end()) words.fail("more follows than a camera");
  QUORUM_TRY(words.done());
  if (const char* defect = camera_defect(result.camera); defect != nullptr)
    return path_failure(path, fmt::format("{}; {}", defect, kCameraRemedy));
  if (result.camera.intrinsics(0, 1) != 0.0) return path_failure(path, "its camera has skew, which is not supported");
  return result;
}

/// Cameras by their numbers.
Expected<std::map<int, fs::path>> list_cameras(const fs::path& folder) {
  std::map<int, fs::path> cameras;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (!name.ends_with(kCameraEnding)) continue;
    const auto number = parse_number<int>(std::string_view(name).substr(0, name.size() - kCameraEnding.size()));
    if (number && *number >= 0) cameras.emplace(*number, entry->path());
  }
  if (cameras.empty()) return path_failure(folder, "holds no camera, 00000000_cam.txt and so on");
  return cameras;
}

/// The photograph of a camera's number: of its eight digits with any extension. Empty if there is none.
fs::path find_image(const std::vector<fs::path>& files, std::string_view stem) {
  const auto file = std::ranges::find(files, stem, [](const fs::path& path) { return path.stem().string(); });
  return file == files.end() ? fs::path() : *file;
}

/// pair.txt: a count; then of each view its number, a count, and as many numbers with scores. view_of: by number.
/// Returns how many numbers stand there for which there is no view.
Expected<int> read_pairs(const fs::path& path, const std::map<int, int>& view_of, std::vector<View>& views) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  WordReader words(path, text);
  int unknown = 0;
  const auto place_of = [&](int number) {
    const auto place = view_of.find(number);
    if (place == view_of.end() && !words.failed()) ++unknown;
    return place != view_of.end() ? place->second : -1;
  };
  const int count = words.number<int>("the count of views");
  for (int i = 0; i < count && !words.failed(); ++i) {
    const int reference = place_of(words.number<int>("the number of a view"));
    std::vector<int> found;
    const int neighbors = words.number<int>("the count of neighbors");
    for (int k = 0; k < neighbors && !words.failed(); ++k) {
      const int neighbor = place_of(words.number<int>("the number of a neighbor"));
      words.number<double>("a score");
      if (neighbor >= 0 && neighbor == reference) words.fail("a view is its own neighbor");
      if (neighbor >= 0 && std::ranges::count(found, neighbor) == 0) found.push_back(neighbor);
    }
    if (reference >= 0) views[static_cast<std::size_t>(reference)].neighbors = std::move(found);
  }
  QUORUM_TRY(words.done());
  return unknown;
}

/// The depth range of a view, or that of the bounds.
Expected<std::pair<double, double>> depth_range(const View& view, const Bounds& bounds) {
  if (view.far_depth > 0) return std::pair(view.near_depth, view.far_depth);
  double near = std::numeric_limits<double>::infinity();
  double far = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const double depth = view.camera.to_camera(bounds.corner(corner)).z();
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  if (far <= 0)
    return failure(ErrorKind::kInput,
                   fmt::format("{}: the bounds lie behind this camera; check {}", view.name, option_name("roi")));
  return std::pair(std::max(near, 1e-3 * far), far);
}

std::string camera_text(const Camera& camera, double near, double far) {
  const Eigen::Matrix3d& r = camera.camera_from_world;
  const Eigen::Matrix3d& k = camera.intrinsics;
  std::string text = "extrinsic\n";
  for (int row = 0; row < 3; ++row)
    text += fmt::format("{} {} {} {}\n", r(row, 0), r(row, 1), r(row, 2), camera.translation(row));
  return text + fmt::format("0 0 0 1\n\nintrinsic\n{} 0 {}\n0 {} {}\n0 0 1\n\n{} {} {} {}\n", k(0, 0), k(0, 2) + 0.5,
                            k(1, 1), k(1, 2) + 0.5, near, (far - near) / (kUsualDepths - 1), kUsualDepths, far);
}

std::string pair_text(const Scene& scene) {
  SelectViewsOptions options;
  options.neighbor_count = 10;
  std::string text = fmt::format("{}\n", scene.views.size());
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const std::vector<int> neighbors = select_views(scene, view, options);
    text += fmt::format("{}\n{}", view, neighbors.size());
    int score = options.neighbor_count;
    for (const int neighbor : neighbors) text += fmt::format(" {} {}", neighbor, score--);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string mvsnet_name(std::size_t number) { return fmt::format("{:08}", number); }

Expected<void> write_mvsnet(OutputFolder& output, const Scene& scene) {
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    QUORUM_ASSIGN(const auto range, depth_range(scene.views[i], scene.bounds));
    const std::string text = camera_text(scene.views[i].camera, range.first, range.second);
    QUORUM_TRY(output.write(fs::path("cams") / (mvsnet_name(i) + std::string(kCameraEnding)), text));
  }
  return output.write("pair.txt", pair_text(scene));
}

Expected<Scene> read_mvsnet(const fs::path& folder, const fs::path& images) {
  QUORUM_ASSIGN(const auto cameras, list_cameras(folder / "cams"));
  const fs::path image_folder = images.empty() ? folder / "images" : images;
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator entry(image_folder, code); !code && entry != fs::directory_iterator();
       entry.increment(code))
    files.push_back(entry->path());
  std::ranges::sort(files);

  ViewList list;
  std::vector<MvsnetCamera> parsed;
  std::map<int, int> view_of;
  for (const auto& [number, path] : cameras) {
    QUORUM_ASSIGN(const auto text, read_file(path));
    QUORUM_ASSIGN(const auto camera, parse_camera(path, text));
    const std::string name = path.filename().string();
    const std::string stem = name.substr(0, name.size() - kCameraEnding.size());
    const fs::path image = find_image(files, stem);
    Lens lens;
    const Eigen::Matrix3d& k = camera.camera.intrinsics;
    lens.focal = {k(0, 0), k(1, 1)};
    lens.principal = {k(0, 2) - 0.5, k(1, 2) - 0.5};
    const auto view = list.add(image.empty() ? stem : image.filename().string(), image, camera.camera, lens);
    if (!view) return std::unexpected(view.error().within(folder.string()));
    if (*view < 0) continue;
    view_of.emplace(number, *view);
    parsed.push_back(camera);
  }
  auto scene = list.finish();
  if (!scene) return std::unexpected(scene.error().within(folder.string()));
  for (std::size_t i = 0; i < parsed.size(); ++i) {
    scene->views[i].near_depth = parsed[i].near_depth;
    scene->views[i].far_depth = parsed[i].far_depth;
  }
  std::error_code ignored;
  for (const fs::path& pairs : {folder / "pair.txt", folder / "cams" / "pair.txt"}) {
    if (!fs::exists(pairs, ignored)) continue;
    QUORUM_ASSIGN(const auto unknown, read_pairs(pairs, view_of, scene->views));
    if (unknown > 0)
      scene->notes.push_back(fmt::format("{}: {} numbers of views that are not in the scene are left out",
                                         pairs.filename().string(), unknown));
    break;
  }
  return scene;
}

}  // namespace quorum
