#include "engine/io/metashape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// From one frame to another: s R p + t.
struct Transform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double scale = 1.0;
};

/// The numbers of an element, N of them; nothing if they are others.
template <int N>
std::optional<std::array<double, N>> numbers_of(const pugi::xml_node& node) {
  const auto tokens = [&] {
    std::string text = node.text().get();
    std::ranges::replace(text, '\n', ' ');
    return text;
  }();
  std::array<double, N> numbers{};
  const auto words = split_tokens(tokens);
  if (words.size() != N) return std::nullopt;
  for (std::size_t i = 0; i < N; ++i) {
    const auto number = parse_number<double>(words[i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

std::unexpected<Error> refuse(std::string message) { return failure(ErrorKind::kInput, std::move(message)); }

/// A number of a calibration, 0 if it is not there.
Expected<double> number_in(const pugi::xml_node& calibration, const char* name) {
  const pugi::xml_node node = calibration.child(name);
  if (!node) return 0.0;
  const auto number = numbers_of<1>(node);
  if (!number) return refuse(fmt::format("its {} is no number", name));
  return (*number)[0];
}

Expected<Lens> parse_calibration(const pugi::xml_node& calibration) {
  const std::string type = calibration.attribute("type").as_string("frame");
  const bool is_fisheye = type == "fisheye" || type == "equidistant_fisheye";
  if (type != "frame" && !is_fisheye)
    return refuse(
        fmt::format("its type {} is not read; export undistorted photographs (Tools > Export > Convert "
                    "Images) or cameras in COLMAP's format",
                    quote_token(type)));
  std::map<std::string, double> value;
  for (const char* name : {"f", "cx", "cy", "b1", "b2", "k1", "k2", "k3", "k4", "p1", "p2", "p3", "p4"}) {
    QUORUM_ASSIGN(value[name], number_in(calibration, name));
  }
  for (const char* name : {"b2", "p3", "p4"})
    if (value[name] != 0.0)
      return refuse(fmt::format("its {} is not 0, which is not understood; optimize the cameras without it", name));
  if (value["f"] == 0.0) return refuse("has no f; export the cameras with a newer version");
  Lens lens;
  lens.width = calibration.child("resolution").attribute("width").as_int();
  lens.height = calibration.child("resolution").attribute("height").as_int();
  if (lens.width <= 0 || lens.height <= 0) return refuse("has no resolution; export the cameras with a newer version");
  lens.focal = {value["f"] + value["b1"], value["f"]};
  lens.principal = {lens.width / 2.0 + value["cx"] - 0.5, lens.height / 2.0 + value["cy"] - 0.5};
  // Its p1 and p2 are OpenCV's p2 and p1.
  if (is_fisheye) {
    lens.model = Lens::Model::kThinPrismFisheye;
    lens.coefficients = {value["k1"], value["k2"], value["p2"], value["p1"], value["k3"], value["k4"]};
  } else {
    lens.coefficients = {value["k1"], value["k2"], value["p2"], value["p1"], value["k3"], 0, 0, 0, value["k4"]};
  }
  return lens;
}

Expected<Lens> parse_sensor(const pugi::xml_node& sensor) {
  for (const pugi::xml_node& calibration : sensor.children("calibration"))
    if (std::string_view(calibration.attribute("class").as_string("adjusted")) == "adjusted")
      return parse_calibration(calibration);
  return refuse("has no adjusted calibration; align the photographs, and export the cameras again");
}

Expected<Transform> parse_transform(const pugi::xml_node& node) {
  Transform transform;
  if (!node) return transform;
  const auto rotation = numbers_of<9>(node.child("rotation"));
  const auto translation = numbers_of<3>(node.child("translation"));
  const auto scale = numbers_of<1>(node.child("scale"));
  if ((node.child("rotation") && !rotation) || (node.child("translation") && !translation) ||
      (node.child("scale") && (!scale || !((*scale)[0] > 0))))
    return refuse("its transform is no rotation, translation and scale");
  if (rotation) transform.rotation = Eigen::Map<const Eigen::Matrix3d>(rotation->data()).transpose();
  if (translation) transform.translation = Eigen::Map<const Eigen::Vector3d>(translation->data());
  if (scale) transform.scale = (*scale)[0];
  return transform;
}

/// The pose of a camera whose 4 x 4 numbers lead from it to the chunk.
Expected<Camera> parse_pose(const pugi::xml_node& node, const Transform& world_from_chunk) {
  const auto numbers = numbers_of<16>(node);
  if (!numbers) return refuse("its transform is not 4 x 4 numbers");
  const Eigen::Matrix4d chunk_from_camera = Eigen::Map<const Eigen::Matrix4d>(numbers->data()).transpose();
  const auto& [rotation, translation, scale] = world_from_chunk;
  Camera camera;
  camera.camera_from_world = (rotation * chunk_from_camera.topLeftCorner<3, 3>()).transpose();
  camera.translation = translation_of_center(
      camera.camera_from_world, translation + scale * (rotation * chunk_from_camera.topRightCorner<3, 1>()));
  return camera;
}

std::vector<pugi::xml_node> cameras_of(const pugi::xml_node& chunk) {
  std::vector<pugi::xml_node> cameras;
  for (const pugi::xpath_node& found : chunk.child("cameras").select_nodes("./camera|./group/camera"))
    cameras.push_back(found.node());
  return cameras;
}

std::ptrdiff_t aligned_count(const pugi::xml_node& chunk) {
  return std::ranges::count_if(
      cameras_of(chunk), [](const pugi::xml_node& camera) { return static_cast<bool>(camera.child("transform")); });
}

/// The chunk with the most aligned cameras; told if it was a choice.
pugi::xml_node choose_chunk(const pugi::xml_node& document, std::vector<std::string>& notes) {
  pugi::xml_node best;
  int count = 0;
  for (const pugi::xml_node& chunk : document.children("chunk")) {
    ++count;
    if (!best || aligned_count(chunk) > aligned_count(best)) best = chunk;
  }
  if (count > 1)
    notes.push_back(fmt::format("of {} chunks {} is taken, with the most aligned cameras, {}", count,
                                quote_token(best.attribute("label").as_string()), aligned_count(best)));
  return best;
}

Expected<void> add_cameras(const pugi::xml_node& chunk, SfmModel& model) {
  std::map<std::string, pugi::xml_node> sensors;
  for (const pugi::xml_node& sensor : chunk.child("sensors").children("sensor"))
    sensors.emplace(sensor.attribute("id").as_string(), sensor);
  std::map<std::string, Transform> transforms;  // of components, in files of version 2
  for (const pugi::xml_node& component : chunk.child("components").children("component")) {
    QUORUM_ASSIGN(transforms[component.attribute("id").as_string()], parse_transform(component.child("transform")));
  }
  QUORUM_ASSIGN(const auto whole, parse_transform(chunk.child("transform")));
  std::map<std::string, Lens> lenses;
  for (const pugi::xml_node& node : cameras_of(chunk)) {
    const std::string label = node.attribute("label").as_string();
    if (!node.child("transform") || !node.attribute("enabled").as_bool(true)) {
      ++model.placeless;
      continue;
    }
    const std::string id = node.attribute("sensor_id").as_string();
    if (!lenses.contains(id)) {
      const auto sensor = sensors.find(id);
      if (sensor == sensors.end())
        return refuse(fmt::format("camera {}: sensor {} is not there", quote_token(label), quote_token(id)));
      const auto lens = parse_sensor(sensor->second);
      if (!lens) return std::unexpected(lens.error().within("sensor " + quote_token(id)));
      lenses.emplace(id, *lens);
    }
    const auto component = transforms.find(node.attribute("component_id").as_string());
    const auto pose = parse_pose(node.child("transform"), component != transforms.end() ? component->second : whole);
    if (!pose) return std::unexpected(pose.error().within("camera " + quote_token(label)));
    model.images.push_back({label, *pose, fixed_lens(lenses.at(id))});
  }
  return {};
}

}  // namespace

bool is_metashape_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(1024, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head.find("<document") != std::string::npos && head.find("<chunk") != std::string::npos;
}

Expected<Scene> read_metashape(const fs::path& path, const fs::path& images) {
  QUORUM_ASSIGN(auto text, read_file(path));
  pugi::xml_document xml;
  const pugi::xml_parse_result parsed = xml.load_buffer(text.data(), text.size());
  if (!parsed) return path_failure(path, fmt::format("is no XML: {} at byte {}", parsed.description(), parsed.offset));
  SfmModel model{path};
  const pugi::xml_node chunk = choose_chunk(xml.child("document"), model.notes);
  if (!chunk) return path_failure(path, "holds no chunk; write it with File > Export > Export Cameras");
  if (const auto added = add_cameras(chunk, model); !added) return std::unexpected(added.error().within(path.string()));
  return make_sfm_scene(std::move(model), photograph_folders(path, images));
}

}  // namespace quorum
