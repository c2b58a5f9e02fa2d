#include "engine/io/openmvg.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/json_values.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// An entry of one of the file's lists: {"key": 3, "value": ...}. Shared objects stand in "ptr_wrapper" as "data".
struct Entry {
  std::string key;
  const Json* value = nullptr;

  [[nodiscard]] const Json& data() const {
    static const Json kNone;
    const Json* wrapper = JsonObject(*value).find("ptr_wrapper");
    const Json* data = wrapper != nullptr ? JsonObject(*wrapper).find("data") : nullptr;
    return data != nullptr ? *data : kNone;
  }
};

Expected<std::vector<Entry>> entries_of(const Json& file, const char* name) {
  std::vector<Entry> entries;
  const Json* list = JsonObject(file).find(name);
  if (list == nullptr || !list->is_array()) return entries;
  for (const Json& item : *list) {
    JsonObject object(item);
    const std::string key = object.text("key");
    const Json* value = object.find("value");
    if (value == nullptr) object.fail("value", "an object");
    if (auto done = object.done(); !done) return std::unexpected(done.error().within(name));
    entries.push_back({key, value});
  }
  return entries;
}

/// The name of an intrinsic's class. It stands where the class comes first; later ones repeat its number alone.
std::string class_of(const Json& value, std::map<std::uint64_t, std::string>& names) {
  constexpr std::uint64_t kFirst = 0x80000000U;
  JsonObject object(value);
  const double number = std::clamp(object.number_or("polymorphic_id", 0.0), 0.0, 4294967295.0);
  const std::uint64_t id = static_cast<std::uint64_t>(number) & (kFirst - 1);
  if (const std::string name = object.text_or_empty("polymorphic_name"); !name.empty()) names[id] = name;
  const auto known = names.find(id);
  return known != names.end() ? known->second : std::string();
}

Expected<Lens> parse_lens(const Json& data, const std::string& type) {
  JsonObject object(data);
  Lens lens;
  lens.width = static_cast<int>(std::clamp(object.number("width"), 0.0, 1e6));
  lens.height = static_cast<int>(std::clamp(object.number("height"), 0.0, 1e6));
  lens.focal.setConstant(object.number("focal_length"));
  lens.principal = object.vector<2>("principal_point");
  if (type == "pinhole_radial_k1") {
    lens.coefficients[0] = object.vector<1>("disto_k1")(0);
  } else if (type == "pinhole_radial_k3") {
    const Eigen::Vector3d k = object.vector<3>("disto_k3");
    lens.coefficients = {k(0), k(1), 0, 0, k(2)};
  } else if (type == "pinhole_brown_t2") {
    const auto k = object.vector<5>("disto_t2");  // k1 k2 k3 t1 t2
    lens.coefficients = {k(0), k(1), k(3), k(4), k(2)};
  } else if (type == "fisheye") {
    const Eigen::Vector4d k = object.vector<4>("fisheye");
    lens.model = Lens::Model::kFisheye;
    lens.coefficients = {k(0), k(1), k(2), k(3)};
  } else if (type != "pinhole") {
    return failure(ErrorKind::kInput,
                   fmt::format("its model {} is not known; undistort with openMVG_main_ExportUndistortedImages, or use "
                               "pinhole, pinhole_radial_k1, pinhole_radial_k3, pinhole_brown_t2 or fisheye",
                               quote_token(type)));
  }
  QUORUM_TRY(object.done());
  return lens;
}

Expected<std::map<std::string, Lens>> parse_intrinsics(const Json& file) {
  QUORUM_ASSIGN(const auto entries, entries_of(file, "intrinsics"));
  std::map<std::uint64_t, std::string> class_names;
  std::map<std::string, Lens> lenses;
  for (const Entry& entry : entries) {
    const auto lens = parse_lens(entry.data(), class_of(*entry.value, class_names));
    if (!lens) return std::unexpected(lens.error().within("intrinsic " + quote_token(entry.key)));
    lenses.emplace(entry.key, *lens);
  }
  return lenses;
}

Expected<std::map<std::string, Camera>> parse_poses(const Json& file) {
  QUORUM_ASSIGN(const auto entries, entries_of(file, "extrinsics"));
  std::map<std::string, Camera> poses;
  for (const Entry& entry : entries) {
    JsonObject object(*entry.value);
    const Json* rows = object.find("rotation");
    Camera camera;
    for (int row = 0; row < 3; ++row) {
      const bool there = rows != nullptr && rows->is_array() && rows->size() == 3;
      const auto values =
          there ? JsonObject::vector_of<3>((*rows)[static_cast<std::size_t>(row)]) : std::optional<Eigen::Vector3d>();
      if (!values) object.fail("rotation", "3 x 3 numbers");
      camera.camera_from_world.row(row) = values.value_or(Eigen::Vector3d::Zero()).transpose();
    }
    camera.translation = translation_of_center(camera.camera_from_world, object.vector<3>("center"));
    if (auto done = object.done(); !done) return std::unexpected(done.error().within("pose " + quote_token(entry.key)));
    poses.emplace(entry.key, camera);
  }
  return poses;
}

/// Adds the images, and gives their places by the ids of their views.
Expected<std::map<std::string, int>> add_views(const Json& file, SfmModel& model) {
  QUORUM_ASSIGN(const auto lenses, parse_intrinsics(file));
  QUORUM_ASSIGN(const auto poses, parse_poses(file));
  QUORUM_ASSIGN(const auto views, entries_of(file, "views"));
  std::map<std::string, int> image_of;
  for (const Entry& entry : views) {
    JsonObject view(entry.data());
    const std::string name = view.text("filename");
    const std::string local = view.text_or_empty("local_path");
    const auto pose = poses.find(view.text("id_pose"));
    const auto lens = lenses.find(view.text("id_intrinsic"));
    const std::string id = view.text("id_view");
    if (auto done = view.done(); !done) return std::unexpected(done.error().within("view " + quote_token(entry.key)));
    if (pose == poses.end() || lens == lenses.end()) {
      ++model.placeless;
      continue;
    }
    image_of.emplace(id, static_cast<int>(model.images.size()));
    const fs::path path = local.find_first_not_of("/\\") == std::string::npos ? fs::path(name) : fs::path(local) / name;
    model.images.push_back({path.string(), pose->second, fixed_lens(lens->second)});
  }
  return image_of;
}

Expected<void> add_tracks(const Json& file, const std::map<std::string, int>& image_of, SfmModel& model) {
  QUORUM_ASSIGN(const auto entries, entries_of(file, "structure"));
  for (const Entry& entry : entries) {
    JsonObject object(*entry.value);
    SparsePoint point{object.vector<3>("X"), {}};
    if (auto done = object.done(); !done)
      return std::unexpected(done.error().within("point " + quote_token(entry.key)));
    QUORUM_ASSIGN(const auto seen, entries_of(*entry.value, "observations"));
    for (const Entry& observation : seen)
      if (const auto image = image_of.find(observation.key); image != image_of.end())
        point.views.push_back(image->second);
    model.points.push_back(std::move(point));
  }
  return {};
}

}  // namespace

Expected<Scene> read_openmvg(const fs::path& path, const fs::path& images) {
  const auto refuse = [&path](const Error& error) { return std::unexpected(error.within(path.string())); };
  QUORUM_ASSIGN(const auto text, read_file(path));
  QUORUM_ASSIGN(const Json file, parse_json(path, text));
  if (!file.is_object()) return path_failure(path, "is no JSON object; check its syntax");
  SfmModel model{path};
  const auto image_of = add_views(file, model);
  if (!image_of) return refuse(image_of.error());
  if (model.images.empty())
    return path_failure(path,
                        "no view has a pose; give the sfm_data.json that openMVG_main_SfM wrote, converted with "
                        "openMVG_main_ConvertSfM_DataFormat -i sfm_data.bin -o sfm_data.json");
  if (const auto added = add_tracks(file, *image_of, model); !added) return refuse(added.error());
  std::vector<fs::path> folders = photograph_folders(path, images);
  JsonObject object(file);
  if (const std::string root = object.text_or_empty("root_path"); images.empty() && !root.empty())
    folders.insert(folders.begin(), {root, path.parent_path() / root});
  return make_sfm_scene(std::move(model), folders);
}

}  // namespace quorum
