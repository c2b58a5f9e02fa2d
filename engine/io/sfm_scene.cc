#include "engine/io/sfm_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/io/find_photograph.h"
#include "engine/io/view_list.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

fs::path find_in(const std::vector<fs::path>& folders, const std::string& name) {
  for (const fs::path& folder : folders)
    if (fs::path found = find_photograph_by_end(folder, name); !found.empty()) return found;
  return {};
}

std::vector<std::string> names_of(const std::vector<SfmImage>& images) {
  std::vector<std::string> names;
  for (const SfmImage& image : images) names.push_back(image.name);
  return names;
}

/// What the photographs are called: their names, but for the folders that all have in common where all are absolute.
std::vector<std::string> labels_of(const std::vector<SfmImage>& images) {
  std::vector<std::string> labels;
  std::size_t common = std::string::npos;  // characters
  for (const SfmImage& image : images) {
    labels.push_back(image.name);
    std::ranges::replace(labels.back(), '\\', '/');
    const std::string& first = labels.front();
    const std::string& name = labels.back();
    const bool has_drive = name.size() > 2 && name[1] == ':' && name[2] == '/';
    if (!has_drive && !name.starts_with('/')) return names_of(images);
    const auto same = std::ranges::mismatch(first, name).in1 - first.begin();
    common = std::min({common, static_cast<std::size_t>(same), first.rfind('/') + 1});
  }
  if (labels.empty() || common == 0) return names_of(images);
  common = labels.front().rfind('/', common - 1) + 1;
  for (std::string& label : labels) label.erase(0, common);
  return labels;
}

/// Sightings by the images that became views.
std::vector<SparsePoint> seen_points(std::vector<SparsePoint> points, const std::vector<int>& view_of) {
  for (SparsePoint& point : points) {
    for (int& view : point.views) view = view_of[static_cast<std::size_t>(view)];
    std::erase(point.views, -1);
    std::ranges::sort(point.views);
    const auto repeated = std::ranges::unique(point.views);
    point.views.erase(repeated.begin(), repeated.end());
  }
  std::erase_if(points, [](const SparsePoint& point) { return point.views.empty() || !point.position.allFinite(); });
  return points;
}

}  // namespace

std::function<Lens(ImageSize)> fixed_lens(const Lens& lens) {
  return [lens](ImageSize) { return lens; };
}

std::vector<fs::path> photograph_folders(const fs::path& file, const fs::path& given) {
  if (!given.empty()) return {given};
  std::vector<fs::path> folders;
  fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  for (int up = 0; up < 3; ++up) {
    folders.push_back(folder);
    folders.push_back(folder / "images");
    folder = folder.parent_path();
  }
  return folders;
}

Expected<Scene> make_sfm_scene(SfmModel model, const std::vector<fs::path>& folders) {
  const auto refuse = [&model](const Error& error) { return std::unexpected(error.within(model.file.string())); };
  std::vector<std::size_t> order(model.images.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&model](std::size_t index) { return model.images[index].name; });
  const std::vector<std::string> labels = labels_of(model.images);
  ViewList list;
  std::vector<int> view_of(order.size(), -1);
  for (const std::size_t index : order) {
    const SfmImage& image = model.images[index];
    const fs::path path = find_in(folders, image.name);
    Lens lens;
    if (!path.empty()) {
      const auto size = read_image_size(path);
      if (!size) return refuse(size.error());
      lens = image.lens(*size);
    }
    const auto added = list.add(labels[index], path, image.pose, lens);
    if (!added) return refuse(added.error());
    view_of[index] = *added;
  }
  auto scene = list.finish();
  if (!scene) return refuse(scene.error());
  scene->points = seen_points(std::move(model.points), view_of);
  if (model.placeless > 0)
    model.notes.push_back(fmt::format("{} of {} photographs have no camera and are left out", model.placeless,
                                      model.placeless + model.images.size()));
  scene->notes.insert(scene->notes.begin(), model.notes.begin(), model.notes.end());
  return scene;
}

std::vector<SparsePoint> points_before(const std::vector<View>& views, const std::vector<Eigen::Vector3d>& positions) {
  constexpr std::size_t kMost = 20000;
  const std::size_t step = positions.size() / kMost + 1;
  std::vector<SparsePoint> points;
  for (std::size_t i = 0; i < positions.size(); i += step) {
    SparsePoint point{positions[i], {}};
    if (!point.position.allFinite()) continue;
    for (std::size_t view = 0; view < views.size(); ++view) {
      const Eigen::Vector3d pixel = views[view].camera.project(point.position);
      if (pixel.z() > 0 && pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= views[view].width - 1 &&
          pixel.y() <= views[view].height - 1)
        point.views.push_back(static_cast<int>(view));
    }
    if (!point.views.empty()) points.push_back(std::move(point));
  }
  return points;
}

}  // namespace quorum
