#include "engine/io/bundler.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/io/file.h"
#include "engine/io/find_photograph.h"
#include "engine/io/image_size.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"
#include "engine/io/word_reader.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTitle = "# Bundle file";

struct BundleCamera {
  double focal = 0.0;  ///< 0 = not found
  double k1 = 0.0;
  double k2 = 0.0;
  Camera pose;
};

struct Bundle {
  std::vector<BundleCamera> cameras;
  std::vector<SparsePoint> points;  ///< views: indices of cameras
};

BundleCamera next_camera(WordReader& words) {
  BundleCamera camera;
  camera.focal = words.number<double>("a focal length");
  camera.k1 = words.number<double>("k1");
  camera.k2 = words.number<double>("k2");
  // Its camera looks along -z with y up, ours along z with y down.
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      camera.pose.camera_from_world(row, column) =
          (row == 0 ? 1.0 : -1.0) * words.number<double>("a value of the rotation");
  for (int row = 0; row < 3; ++row)
    camera.pose.translation(row) = (row == 0 ? 1.0 : -1.0) * words.number<double>("a value of the translation");
  return camera;
}

SparsePoint next_point(WordReader& words, std::size_t camera_count) {
  SparsePoint point;
  for (int axis = 0; axis < 3; ++axis) point.position(axis) = words.number<double>("a coordinate");
  for (int channel = 0; channel < 3; ++channel) words.number<double>("a color");
  const auto sightings = words.number<std::uint64_t>("the count of views of a point");
  for (std::uint64_t i = 0; i < sightings && !words.failed(); ++i) {
    const auto camera = words.number<std::uint64_t>("the camera of a sighting");
    if (camera >= camera_count) words.fail(fmt::format("a point refers to camera {} of {}", camera, camera_count));
    words.number<std::uint64_t>("the key of a sighting");
    words.number<double>("x of a sighting");
    words.number<double>("y of a sighting");
    point.views.push_back(static_cast<int>(camera));
  }
  std::ranges::sort(point.views);
  const auto repeated = std::ranges::unique(point.views);
  point.views.erase(repeated.begin(), repeated.end());
  return point;
}

Expected<Bundle> parse_bundle(const fs::path& path, std::string_view text) {
  if (!text.starts_with(kTitle)) return path_failure(path, "does not begin with \"# Bundle file v0.3\"");
  std::string body(text);
  std::fill_n(body.begin(), std::min(body.find('\n'), body.size()), ' ');
  WordReader words(path, body);
  const auto camera_count = words.number<std::uint64_t>("the count of cameras");
  const auto point_count = words.number<std::uint64_t>("the count of points");
  Bundle bundle;
  for (std::uint64_t i = 0; i < camera_count && !words.failed(); ++i) bundle.cameras.push_back(next_camera(words));
  for (std::uint64_t i = 0; i < point_count && !words.failed(); ++i)
    bundle.points.push_back(next_point(words, bundle.cameras.size()));
  if (!words.at_end()) words.fail("more follows than the points that were counted");
  QUORUM_TRY(words.done());
  return bundle;
}

/// The lines of list.txt.
Expected<std::vector<std::string>> read_list(const fs::path& path) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  std::vector<std::string> names;
  LineReader lines(text);
  while (auto line = lines.next_filled()) {
    line->remove_prefix(line->find_first_not_of(kTextSpace));
    names.emplace_back(line->substr(0, line->find_last_not_of(kTextSpace) + 1));
  }
  return names;
}

/// A line without the columns "0 650.5" (a focal length in pixels) or "0" that may follow a path.
std::string without_focal(const std::string& line) {
  const auto tokens = split_tokens(line);
  std::size_t numbers = 0;
  while (numbers < 2 && numbers + 1 < tokens.size() && parse_number<double>(tokens[tokens.size() - 1 - numbers]))
    ++numbers;
  if (numbers == 0 || tokens[tokens.size() - numbers] != "0") return line;
  const std::string_view last = tokens[tokens.size() - 1 - numbers];
  return line.substr(0, static_cast<std::size_t>(last.data() + last.size() - line.data()));
}

}  // namespace

fs::path find_bundle(const fs::path& folder) {
  for (const fs::path& candidate : {folder / "bundle.out", folder / "bundle" / "bundle.out"})
    if (is_file(candidate)) return candidate;
  return {};
}

Expected<Scene> read_bundler(const fs::path& folder, const fs::path& images) {
  const fs::path path = find_bundle(folder);
  if (path.empty()) return path_failure(folder, "holds neither bundle.out nor bundle/bundle.out");
  QUORUM_ASSIGN(const auto text, read_file(path));
  QUORUM_ASSIGN(auto bundle, parse_bundle(path, text));
  QUORUM_ASSIGN(const auto names, read_list(folder / "list.txt"));
  if (names.size() != bundle.cameras.size())
    return path_failure(folder / "list.txt", fmt::format("names {} images, but {} holds {} cameras", names.size(),
                                                         path.string(), bundle.cameras.size()));
  ViewList list;
  std::vector<int> view_of(names.size(), -1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const BundleCamera& camera = bundle.cameras[i];
    if (camera.focal == 0.0) continue;
    const fs::path image_folder = images.empty() ? folder : images;
    std::string name = names[i];
    fs::path image = find_photograph(image_folder, name);
    if (image.empty()) {
      name = without_focal(name);
      image = find_photograph(image_folder, name);
    }
    Lens lens;
    if (!image.empty()) {
      const auto size = read_image_size(image);
      if (!size) return std::unexpected(size.error().within(path.string()));
      lens.width = size->width;
      lens.height = size->height;
    }
    lens.focal = {camera.focal, camera.focal};
    lens.principal = {(lens.width - 1) / 2.0, (lens.height - 1) / 2.0};
    lens.coefficients = {camera.k1, camera.k2};
    const auto added = list.add(fs::path(name).lexically_normal().string(), image, camera.pose, lens);
    if (!added) return std::unexpected(added.error().within(path.string()));
    view_of[i] = *added;
  }
  auto scene = list.finish();
  if (!scene) return std::unexpected(scene.error().within(path.string()));
  for (SparsePoint& point : bundle.points) {
    for (int& view : point.views) view = view_of[static_cast<std::size_t>(view)];
    std::erase(point.views, -1);
  }
  std::erase_if(bundle.points, [](const SparsePoint& point) { return !point.position.allFinite(); });
  scene->points = std::move(bundle.points);
  return scene;
}

}  // namespace quorum
