#include "engine/io/colmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "engine/camera/pose.h"
#include "engine/core/option.h"
#include "engine/io/find_photograph.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The folder in which most of the images stand; halves and such only where none is at full size.
Expected<fs::path> find_images(const fs::path& folder, const fs::path& model, const fs::path& given,
                               const std::vector<ColmapImage>& images) {
  if (!given.empty()) return given;
  fs::path best;
  std::ptrdiff_t most = 0;
  const fs::path above = model.parent_path().parent_path();
  // Gaussian splatting keeps the photographs of a distorted model in input, and others of the same names in images.
  const bool is_distorted = above.filename() == "distorted" || model.parent_path().filename() == "distorted";
  for (const fs::path& candidate :
       {is_distorted ? folder / "input" : folder / "images", folder / "images", folder, model / "images",
        model.parent_path() / "images", above / "images", above.parent_path() / "images", folder / "images_2",
        folder / "images_4", folder / "images_8"}) {
    if (most > 0 && candidate.parent_path() == folder && candidate.filename().string().starts_with("images_")) break;
    std::error_code ignored;
    if (!fs::is_directory(candidate, ignored)) continue;
    const auto count = std::ranges::count_if(
        images, [&](const ColmapImage& image) { return !find_photograph(candidate, image.name).empty(); });
    if (count <= most) continue;
    most = count;
    best = candidate;
  }
  if (most > 0) return best;
  return path_failure(folder / "images", fmt::format("image {} of the model is not there; give the folder with {}",
                                                     quote_token(images.front().name), option_name("images")));
}

Expected<Camera> camera_of(const ColmapImage& image) {
  const double norm = Eigen::Map<const Eigen::Vector4d>(image.rotation.data()).norm();
  Camera camera;
  camera.camera_from_world = rotation_of_quaternion(image.rotation);
  camera.translation = image.translation;
  if (const char* defect = camera_defect(camera); defect != nullptr || !(norm > 1e-6))
    return failure(ErrorKind::kInput,
                   fmt::format("image {} (\"{}\"): its pose is none: {}; {}", image.id, image.name,
                               defect != nullptr ? defect : "the quaternion is zero", kCameraRemedy));
  return camera;
}

/// The points with the views that see them; views: by the ids of their images.
std::vector<SparsePoint> points_of(const ColmapModel& model, const std::unordered_map<std::uint32_t, int>& view_of) {
  std::vector<SparsePoint> points;
  points.reserve(model.points.size());
  for (const ColmapPoint& point : model.points) {
    if (!point.position.allFinite()) continue;
    SparsePoint seen{point.position, {}};
    for (const std::uint32_t image : point.image_ids)
      if (const int view = view_of.at(image); view >= 0) seen.views.push_back(view);
    std::ranges::sort(seen.views);
    const auto repeated = std::ranges::unique(seen.views);
    seen.views.erase(repeated.begin(), repeated.end());
    if (point.image_ids.empty() || !seen.views.empty()) points.push_back(std::move(seen));
  }
  return points;
}

const ColmapCameraModel& pinhole_model() {
  constexpr int kPinhole = 1;
  return *std::ranges::find(colmap_camera_models(), kPinhole, &ColmapCameraModel::id);
}

}  // namespace

std::vector<ColmapModelFolder> list_colmap_models(const fs::path& folder) {
  std::vector<ColmapModelFolder> models;
  const fs::path of_nerfstudio = folder / "colmap" / "sparse";
  const fs::path of_splatting = folder / "distorted" / "sparse";
  for (const fs::path& parent : {folder / "sparse", folder, of_nerfstudio, of_splatting}) {
    std::vector<fs::path> candidates = {parent};
    std::error_code code;
    for (fs::directory_iterator entry(parent, code); !code && entry != fs::directory_iterator(); entry.increment(code))
      if (std::error_code ignored; entry->is_directory(ignored)) candidates.push_back(entry->path());
    for (const fs::path& candidate : candidates)
      if (!colmap_model_kind(candidate).empty())
        models.push_back(
            {candidate, count_colmap_images(candidate), parent == of_nerfstudio || parent == of_splatting});
    if (!models.empty()) break;
  }
  std::ranges::sort(models, [](const ColmapModelFolder& a, const ColmapModelFolder& b) {
    return a.image_count != b.image_count ? a.image_count > b.image_count : a.path < b.path;
  });
  return models;
}

fs::path find_colmap_model(const fs::path& folder) {
  const auto models = list_colmap_models(folder);
  return models.empty() ? fs::path() : models.front().path;
}

Lens lens_of(const ColmapCamera& camera) {
  const auto& parameters = camera.parameters;
  const std::size_t focals = camera.model->focal_count;
  Lens lens;
  lens.model = camera.model->lens;
  lens.width = camera.width;
  lens.height = camera.height;
  lens.focal = {parameters[0], parameters[focals - 1]};
  lens.principal = {parameters[focals] - 0.5, parameters[focals + 1] - 0.5};
  std::copy(parameters.begin() + static_cast<std::ptrdiff_t>(focals) + 2, parameters.end(), lens.coefficients.begin());
  return lens;
}

namespace {

/// The folder of the model that is to be read, and what is to be said of the choice.
Expected<fs::path> choose_model(const fs::path& folder, const fs::path& given, std::vector<std::string>& notes) {
  if (!given.empty()) {
    for (const fs::path& candidate : {folder / given, folder / "sparse" / given, given})
      if (!colmap_model_kind(candidate).empty()) return candidate;
    return path_failure(folder / given,
                        "holds no COLMAP model; give " + option_name("model") + " a folder such as sparse/0");
  }
  const auto models = list_colmap_models(folder);
  if (models.empty()) return path_failure(folder, "no COLMAP model in this folder; give the folder of one model");
  if (models.size() == 1) return models.front().path;
  std::string others;
  for (std::size_t i = 1; i < models.size(); ++i)
    others += fmt::format("{}{} {}", i == 1 ? "" : ", ", models[i].path.lexically_relative(folder).string(),
                          models[i].image_count);
  notes.push_back(fmt::format("{} is taken, the largest of {} models, with {} images ({}); {} chooses another",
                              models.front().path.lexically_relative(folder).string(), models.size(),
                              models.front().image_count, others, option_name("model")));
  return models.front().path;
}

}  // namespace

Expected<Scene> read_colmap(const fs::path& folder, const fs::path& images, const fs::path& chosen) {
  std::vector<std::string> notes;
  QUORUM_ASSIGN(const auto model_folder, choose_model(folder, chosen, notes));
  QUORUM_ASSIGN(auto model, read_colmap_model(model_folder));
  std::ranges::sort(model.images, {}, &ColmapImage::name);
  if (model.images.empty()) return path_failure(model_folder, "the model holds no image");
  if (model.lost_sightings > 0)
    notes.push_back(fmt::format("{} sightings of points by images that the model does not hold are left out",
                                model.lost_sightings));
  QUORUM_ASSIGN(const auto image_folder, find_images(folder, model_folder, images, model.images));
  if (image_folder.filename().string().starts_with("images_"))
    notes.push_back(fmt::format("the photographs are those of {}", image_folder.filename().string()));

  std::map<std::uint32_t, Lens> lens_of_camera;
  for (const ColmapCamera& camera : model.cameras) lens_of_camera.emplace(camera.id, lens_of(camera));
  ViewList list;
  std::unordered_map<std::uint32_t, int> view_of;
  for (const ColmapImage& image : model.images) {
    const auto pose = camera_of(image);
    if (!pose) return std::unexpected(pose.error().within(model_folder.string()));
    const auto added =
        list.add(image.name, find_photograph(image_folder, image.name), *pose, lens_of_camera.at(image.camera_id));
    if (!added) return std::unexpected(added.error().within(model_folder.string()));
    view_of.emplace(image.id, *added);
  }
  auto scene = list.finish();
  if (!scene) return std::unexpected(scene.error().within(model_folder.string()));
  scene->points = points_of(model, view_of);
  scene->notes.insert(scene->notes.begin(), notes.begin(), notes.end());
  return scene;
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
