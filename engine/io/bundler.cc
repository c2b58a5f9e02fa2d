#include "engine/io/bundler.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/io/file.h"
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
  if (auto done = words.done(); !done) return std::unexpected(done.error());
  return bundle;
}

/// First words of the lines of list.txt.
Expected<std::vector<std::string>> read_list(const fs::path& path) {
  const auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  std::vector<std::string> names;
  LineReader lines(*text);
  while (const auto line = lines.next_filled()) names.emplace_back(split_tokens(*line).front());
  return names;
}

}  // namespace

fs::path find_bundle(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& candidate : {folder / "bundle.out", folder / "bundle" / "bundle.out"})
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  return {};
}

Expected<Scene> read_bundler(const fs::path& folder, const fs::path& images) {
  const fs::path path = find_bundle(folder);
  if (path.empty()) return path_failure(folder, "holds neither bundle.out nor bundle/bundle.out");
  const auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  auto bundle = parse_bundle(path, *text);
  if (!bundle) return std::unexpected(bundle.error());
  const auto names = read_list(folder / "list.txt");
  if (!names) return std::unexpected(names.error());
  if (names->size() != bundle->cameras.size())
    return path_failure(folder / "list.txt", fmt::format("names {} images, but {} holds {} cameras", names->size(),
                                                         path.string(), bundle->cameras.size()));
  ViewList list;
  std::vector<int> view_of(names->size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < names->size(); ++i) {
    const BundleCamera& camera = bundle->cameras[i];
    if (camera.focal == 0.0) continue;
    const fs::path image = (images.empty() ? folder : images) / (*names)[i];
    const auto size = read_image_size(image);
    if (!size) return std::unexpected(size.error().within(path.string()));
    Lens lens;
    lens.width = size->width;
    lens.height = size->height;
    lens.focal = {camera.focal, camera.focal};
    lens.principal = {(size->width - 1) / 2.0, (size->height - 1) / 2.0};
    lens.coefficients = {camera.k1, camera.k2};
    if (auto added = list.add(fs::path((*names)[i]).lexically_normal().string(), image, camera.pose, lens); !added)
      return std::unexpected(added.error().within(path.string()));
    view_of[i] = count++;
  }
  auto views = list.finish();
  if (!views) return std::unexpected(views.error().within(path.string()));
  for (SparsePoint& point : bundle->points) {
    for (int& view : point.views) view = view_of[static_cast<std::size_t>(view)];
    std::erase(point.views, -1);
  }
  std::erase_if(bundle->points, [](const SparsePoint& point) { return !point.position.allFinite(); });
  return Scene{std::move(*views), {}, std::move(bundle->points)};
}

}  // namespace quorum
