#include "engine/io/meshroom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
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
using Version = std::array<int, 3>;

const Json& list_of(const Json& json, const char* name) {
  static const Json kNone = Json::array();
  const Json* found = JsonObject(json).find(name);
  return found != nullptr && found->is_array() ? *found : kNone;
}

/// Focal lengths in pixels, which were written in four ways.
Eigen::Vector2d focal_of(JsonObject& intrinsic, const Version& version, double width) {
  if (version < Version{1, 2, 0}) return Eigen::Vector2d::Constant(intrinsic.number("pxFocalLength"));
  if (version < Version{1, 2, 2}) return intrinsic.vector<2>("pxFocalLength");
  const double x = intrinsic.number("focalLength") / intrinsic.number_or("sensorWidth", 36.0) * width;
  const double ratio = intrinsic.number_or("pixelRatio", 1.0);
  return {x, version < Version{1, 2, 5} ? x / ratio : x * ratio};
}

/// Its kind is told by two members, of which the newer one may say nothing.
std::string kind_of(JsonObject& intrinsic) {
  std::string kind = intrinsic.text_or_empty("distortionType");
  if (kind.empty()) kind = intrinsic.text("type");
  return intrinsic.text_or_empty("type").starts_with("equi") ? "equidistant" : kind;
}

Expected<void> set_distortion(JsonObject& intrinsic, const Json& json, Lens& lens) {
  std::vector<double> k;
  for (const Json& value : list_of(json, "distortionParams")) k.push_back(JsonObject::number_of(value).value_or(NAN));
  const bool bends = std::ranges::any_of(k, [](double value) { return value != 0.0; });
  const std::string kind = kind_of(intrinsic);
  const auto takes = [&](std::initializer_list<const char*> names, std::size_t count) {
    if (std::ranges::count(names, kind) == 0) return false;
    if (k.empty()) k.resize(count);
    if (k.size() != count) intrinsic.fail("distortionParams", fmt::format("{} numbers", count));
    k.resize(count);
    return true;
  };
  if (takes({"radial1", "radialk1"}, 1)) {
    lens.coefficients[0] = k[0];
  } else if (takes({"radial3", "radialk3"}, 3)) {
    lens.coefficients = {k[0], k[1], 0, 0, k[2]};
  } else if (takes({"brown"}, 5)) {  // k1 k2 k3 t1 t2
    lens.coefficients = {k[0], k[1], k[3], k[4], k[2]};
  } else if (takes({"fisheye", "fisheye4"}, 4)) {
    lens.model = Lens::Model::kFisheye;
    lens.coefficients = {k[0], k[1], k[2], k[3]};
  } else if (takes({"fisheye1"}, 1)) {
    lens.model = Lens::Model::kFov;
    lens.coefficients[0] = k[0];
  } else if ((kind != "pinhole" && kind != "none") || bends) {
    return failure(ErrorKind::kInput,
                   fmt::format("its distortion {} is not read; Meshroom's node ExportImages undistorts the photographs",
                               quote_token(kind)));
  }
  for (const Json& value : list_of(json, "undistortionParams"))
    if (JsonObject::number_of(value) != 0.0) intrinsic.fail("undistortionParams", "empty, which alone is understood");
  return {};
}

Expected<Lens> parse_lens(const Json& json, const Version& version) {
  JsonObject intrinsic(json);
  Lens lens;
  lens.width = static_cast<int>(std::clamp(intrinsic.number("width"), 0.0, 1e6));
  lens.height = static_cast<int>(std::clamp(intrinsic.number("height"), 0.0, 1e6));
  lens.focal = focal_of(intrinsic, version, lens.width);
  lens.principal = intrinsic.vector<2>("principalPoint");
  if (version >= Version{1, 2, 1}) lens.principal += Eigen::Vector2d(lens.width / 2.0, lens.height / 2.0);
  QUORUM_TRY(set_distortion(intrinsic, json, lens));
  QUORUM_TRY(intrinsic.done());
  return lens;
}

Expected<Camera> parse_pose(const Json& json) {
  JsonObject pose(json);
  const Json* inner = pose.find("pose");
  const Json* transform = inner != nullptr ? JsonObject(*inner).find("transform") : nullptr;
  if (transform == nullptr) pose.fail("pose", "an object with a transform");
  QUORUM_TRY(pose.done());
  JsonObject values(*transform);
  const auto rotation = values.vector<9>("rotation");
  Camera camera;
  for (int i = 0; i < 9; ++i) camera.camera_from_world(i % 3, i / 3) = rotation(i);
  camera.translation = translation_of_center(camera.camera_from_world, values.vector<3>("center"));
  QUORUM_TRY(values.done());
  return camera;
}

/// The entries of a list by an id that each has.
template <typename Value, typename Parse>
Expected<std::map<std::string, Value>> by_id(const Json& file, const char* list, const char* id, Parse parse) {
  std::map<std::string, Value> values;
  for (const Json& json : list_of(file, list)) {
    JsonObject object(json);
    const std::string key = object.text(id);
    if (auto done = object.done(); !done) return std::unexpected(done.error().within(list));
    const auto value = parse(json);
    if (!value) return std::unexpected(value.error().within(fmt::format("{} {}", id, quote_token(key))));
    values.emplace(key, *value);
  }
  return values;
}

/// Adds the images, and gives their places by the ids of their views.
Expected<std::map<std::string, int>> add_images(const Json& file, const Version& version, SfmModel& model) {
  QUORUM_ASSIGN(const auto lenses, by_id<Lens>(file, "intrinsics", "intrinsicId",
                                               [&](const Json& json) { return parse_lens(json, version); }));
  QUORUM_ASSIGN(const auto poses, by_id<Camera>(file, "poses", "poseId", parse_pose));
  std::map<std::string, int> image_of;
  for (const Json& json : list_of(file, "views")) {
    JsonObject view(json);
    const std::string id = view.text("viewId");
    const std::string path = view.text("path");
    const auto pose = poses.find(view.text_or_empty("poseId"));
    const auto lens = lenses.find(view.text_or_empty("intrinsicId"));
    if (view.find("rigId") != nullptr) view.fail("rigId", "absent; poses of rigs are not read");
    if (auto done = view.done(); !done) return std::unexpected(done.error().within("view " + quote_token(id)));
    if (pose == poses.end() || lens == lenses.end()) {
      ++model.placeless;
      continue;
    }
    image_of.emplace(id, static_cast<int>(model.images.size()));
    model.images.push_back({path, pose->second, fixed_lens(lens->second)});
  }
  return image_of;
}

Expected<void> add_landmarks(const Json& file, const std::map<std::string, int>& image_of, SfmModel& model) {
  for (const Json& json : list_of(file, "structure")) {
    JsonObject landmark(json);
    SparsePoint point{landmark.vector<3>("X"), {}};
    for (const Json& seen : list_of(json, "observations"))
      if (const auto image = image_of.find(JsonObject(seen).text_or_empty("observationId")); image != image_of.end())
        point.views.push_back(image->second);
    if (auto done = landmark.done(); !done) return std::unexpected(done.error().within("a landmark"));
    model.points.push_back(std::move(point));
  }
  return {};
}

}  // namespace

Expected<Scene> read_meshroom(const fs::path& path, const fs::path& images) {
  const auto refuse = [&path](const Error& error) { return std::unexpected(error.within(path.string())); };
  QUORUM_ASSIGN(const auto text, read_file(path));
  QUORUM_ASSIGN(const Json file, parse_json(path, text));
  if (!file.is_object()) return path_failure(path, "is no JSON object; check its syntax");
  JsonObject object(file);
  const Eigen::Vector3d numbers = object.vector<3>("version");
  if (const auto done = object.done(); !done) return refuse(done.error());
  Version version;
  for (std::size_t i = 0; i < 3; ++i)
    version[i] = static_cast<int>(std::clamp(numbers(static_cast<Eigen::Index>(i)), 0.0, 1e6));
  if (version >= Version{1, 3, 0})
    return path_failure(path, "is of a newer version than 1.2; aliceVision_exportColmap writes COLMAP's files");
  SfmModel model{path};
  const auto image_of = add_images(file, version, model);
  if (!image_of) return refuse(image_of.error());
  if (model.images.empty())
    return path_failure(path, "no view has a pose; give the file of the node StructureFromMotion");
  if (const auto added = add_landmarks(file, *image_of, model); !added) return refuse(added.error());
  return make_sfm_scene(std::move(model), photograph_folders(path, images));
}

}  // namespace quorum
