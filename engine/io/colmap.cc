#include "engine/io/colmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "engine/camera/pose.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The folder in which the first image stands.
Expected<fs::path> find_images(const fs::path& folder, const fs::path& model, const fs::path& given,
                               const std::string& first) {
  if (!given.empty()) return given;
  std::error_code ignored;
  for (const fs::path& candidate : {folder / "images", folder, model / "images", model.parent_path() / "images",
                                    model.parent_path().parent_path() / "images"})
    if (fs::is_regular_file(candidate / first, ignored)) return candidate;
  return path_failure(folder / "images",
                      fmt::format("image \"{}\" of the model is not there; give the folder with --images", first));
}

Expected<Camera> camera_of(const ColmapImage& image) {
  const double norm = Eigen::Map<const Eigen::Vector4d>(image.rotation.data()).norm();
  Camera camera;
  camera.camera_from_world = rotation_of_quaternion(image.rotation);
  camera.translation = image.translation;
  if (const char* defect = camera_defect(camera); defect != nullptr || !(norm > 1e-6))
    return failure(ErrorKind::kInput, fmt::format("image {} (\"{}\"): its pose is none: {}", image.id, image.name,
                                                  defect != nullptr ? defect : "the quaternion is zero"));
  return camera;
}

/// The points with the views that see them; views: by the ids of their images.
std::vector<SparsePoint> points_of(const ColmapModel& model, const std::unordered_map<std::uint32_t, int>& view_of) {
  std::vector<SparsePoint> points;
  points.reserve(model.points.size());
  for (const ColmapPoint& point : model.points) {
    if (!point.position.allFinite()) continue;
    SparsePoint seen{point.position, {}};
    for (const std::uint32_t image : point.image_ids) seen.views.push_back(view_of.at(image));
    std::ranges::sort(seen.views);
    const auto repeated = std::ranges::unique(seen.views);
    seen.views.erase(repeated.begin(), repeated.end());
    points.push_back(std::move(seen));
  }
  return points;
}

const ColmapCameraModel& pinhole_model() {
  constexpr int kPinhole = 1;
  return *std::ranges::find(colmap_camera_models(), kPinhole, &ColmapCameraModel::id);
}

}  // namespace

fs::path find_colmap_model(const fs::path& folder) {
  for (const fs::path& candidate : {folder / "sparse", folder / "sparse" / "0", folder})
    if (!colmap_model_kind(candidate).empty()) return candidate;
  fs::path only;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code)) {
    if (colmap_model_kind(entry->path()).empty()) continue;
    if (!only.empty()) return {};
    only = entry->path();
  }
  return only;
}

Lens lens_of(const ColmapCamera& camera) {
  const auto& parameters = camera.parameters;
  const std::size_t focals = camera.model->focal_count;
  Lens lens;
  lens.model = camera.model->is_fisheye ? Lens::Model::kFisheye : Lens::Model::kRadial;
  lens.width = camera.width;
  lens.height = camera.height;
  lens.focal = {parameters[0], parameters[focals - 1]};
  lens.principal = {parameters[focals] - 0.5, parameters[focals + 1] - 0.5};
  std::copy(parameters.begin() + static_cast<std::ptrdiff_t>(focals) + 2, parameters.end(), lens.coefficients.begin());
  return lens;
}

Expected<Scene> read_colmap(const fs::path& folder, const fs::path& images) {
  const fs::path model_folder = find_colmap_model(folder);
  if (model_folder.empty())
    return path_failure(folder, "no COLMAP model, or several, in this folder; give the folder of one model");
  auto model = read_colmap_model(model_folder);
  if (!model) return std::unexpected(model.error());
  std::ranges::sort(model->images, {}, &ColmapImage::name);
  if (model->images.empty()) return path_failure(model_folder, "the model holds no image");
  const auto image_folder = find_images(folder, model_folder, images, model->images.front().name);
  if (!image_folder) return std::unexpected(image_folder.error());

  std::map<std::uint32_t, Lens> lens_of_camera;
  for (const ColmapCamera& camera : model->cameras) lens_of_camera.emplace(camera.id, lens_of(camera));
  ViewList list;
  std::unordered_map<std::uint32_t, int> view_of;
  for (const ColmapImage& image : model->images) {
    const auto pose = camera_of(image);
    if (!pose) return std::unexpected(pose.error().within(model_folder.string()));
    view_of.emplace(image.id, static_cast<int>(view_of.size()));
    if (auto added = list.add(image.name, *image_folder / image.name, *pose, lens_of_camera.at(image.camera_id));
        !added)
      return std::unexpected(added.error().within(model_folder.string()));
  }
  auto views = list.finish();
  if (!views) return std::unexpected(views.error().within(model_folder.string()));
  return Scene{std::move(*views), {}, points_of(*model, view_of)};
}

ColmapModel colmap_model_of(const std::vector<View>& views, const std::vector<std::string>& names,
                            const std::vector<SparsePoint>& points) {
  ColmapModel model;
  for (std::uint32_t index = 0; index < views.size(); ++index) {
    const View& view = views[index];
    const Camera& camera = view.camera;
    const Eigen::Matrix3d& k = camera.intrinsics;
    model.cameras.push_back(
        {index + 1, &pinhole_model(), view.width, view.height, {k(0, 0), k(1, 1), k(0, 2) + 0.5, k(1, 2) + 0.5}});
    model.images.push_back(
        {index + 1, quaternion_of_rotation(camera.camera_from_world), camera.translation, index + 1, names[index], {}});
  }
  std::uint64_t id = 0;
  for (const SparsePoint& point : points) {
    model.points.push_back({++id, point.position, {128, 128, 128}, {}});
    for (const int view : point.views) {
      const auto index = static_cast<std::size_t>(view);
      const Eigen::Vector3d pixel = views[index].camera.project(point.position);
      model.images[index].observations.push_back({pixel.head<2>().array() + 0.5, id});
    }
  }
  return model;
}

}  // namespace quorum
