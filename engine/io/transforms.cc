#include "engine/io/transforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/image_size.h"
#include "engine/io/text.h"
#include "engine/io/view_list.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Frame {
  std::string name;
  Camera pose;
  const Json* values = nullptr;
};

/// A value of a frame, or else of the file.
class Values {
 public:
  Values(const Json& frame, const Json& file) : frame_(frame), file_(file) {}

  /// Nothing if it is in neither, or no number.
  [[nodiscard]] std::optional<double> number(const char* name) const {
    for (const Json* source : {&frame_, &file_})
      if (const auto place = source->find(name); place != source->end())
        return place->is_number() ? std::optional<double>(place->get<double>()) : std::nullopt;
    return std::nullopt;
  }
  [[nodiscard]] std::string word(const char* name) const {
    for (const Json* source : {&frame_, &file_})
      if (const auto place = source->find(name); place != source->end() && place->is_string())
        return place->get<std::string>();
    return {};
  }

 private:
  const Json& frame_;
  const Json& file_;
};

/// Camera to world in OpenGL's axes becomes world to camera in ours.
std::optional<Camera> pose_of(const Json& frame) {
  const auto rows = frame.find("transform_matrix");
  if (rows == frame.end() || !rows->is_array() || rows->size() < 3) return std::nullopt;
  Eigen::Matrix3d world_from_camera;
  Eigen::Vector3d center;
  for (int row = 0; row < 3; ++row) {
    const Json& values = (*rows)[static_cast<std::size_t>(row)];
    if (!values.is_array() || values.size() != 4) return std::nullopt;
    for (int column = 0; column < 4; ++column) {
      const Json& value = values[static_cast<std::size_t>(column)];
      if (!value.is_number()) return std::nullopt;
      (column < 3 ? world_from_camera(row, column) : center(row)) = value.get<double>();
    }
  }
  world_from_camera.col(1) *= -1.0;
  world_from_camera.col(2) *= -1.0;
  Camera camera;
  camera.camera_from_world = world_from_camera.transpose();
  camera.translation = translation_of_center(camera.camera_from_world, center);
  return camera;
}

/// size: of the photograph.
Expected<Lens> lens_of(const Values& values, ImageSize size) {
  Lens lens;
  const auto width = values.number("w");
  const auto height = values.number("h");
  lens.width = width ? static_cast<int>(std::clamp(*width, 0.0, 1e6)) : size.width;
  lens.height = height ? static_cast<int>(std::clamp(*height, 0.0, 1e6)) : size.height;
  auto focal_x = values.number("fl_x");
  if (const auto angle = values.number("camera_angle_x"); !focal_x && angle)
    focal_x = 0.5 * lens.width / std::tan(0.5 * *angle);
  if (!focal_x) return failure(ErrorKind::kInput, "neither fl_x nor camera_angle_x is a number");
  lens.focal = {*focal_x, values.number("fl_y").value_or(*focal_x)};
  lens.principal = {values.number("cx").value_or(lens.width / 2.0) - 0.5,
                    values.number("cy").value_or(lens.height / 2.0) - 0.5};
  const auto coefficient = [&values](const char* name) { return values.number(name).value_or(0.0); };
  if (values.word("camera_model") == "OPENCV_FISHEYE") {
    lens.model = Lens::Model::kFisheye;
    lens.coefficients = {coefficient("k1"), coefficient("k2"), coefficient("k3"), coefficient("k4")};
  } else {
    lens.coefficients = {coefficient("k1"), coefficient("k2"), coefficient("p1"), coefficient("p2"), coefficient("k3")};
  }
  return lens;
}

}  // namespace

Expected<Scene> read_transforms(const fs::path& folder, const fs::path& images) {
  const fs::path path = folder / "transforms.json";
  const auto refuse = [&path](std::string_view message) {
    return failure(ErrorKind::kInput, fmt::format("{}: {}", path.string(), message));
  };
  const auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  const Json file = Json::parse(*text, nullptr, false);
  if (!file.is_object()) return refuse("is no JSON object; check its syntax");
  const auto list = file.find("frames");
  if (list == file.end() || !list->is_array()) return refuse("has no list \"frames\"");

  const fs::path image_folder = images.empty() ? folder : images;
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& frame = (*list)[i];
    const auto name = frame.find("file_path");
    if (!frame.is_object() || name == frame.end() || !name->is_string())
      return refuse(fmt::format("frame {} has no file_path", i));
    if (has_control_characters(name->get<std::string>()))
      return refuse(fmt::format("frame {}: its file_path has control characters", i));
    const auto pose = pose_of(frame);
    if (!pose) return refuse(fmt::format("frame {}: transform_matrix is no 4 x 4 matrix of numbers", i));
    std::string image = fs::path(name->get<std::string>()).lexically_normal().string();
    std::error_code ignored;
    if (!fs::exists(image_folder / image, ignored)) image += ".png";
    frames.push_back({image, *pose, &frame});
  }
  std::ranges::sort(frames, {}, &Frame::name);
  ViewList views;
  for (const Frame& frame : frames) {
    const auto size = read_image_size(image_folder / frame.name);
    if (!size) return std::unexpected(size.error().within(path.string()));
    const auto lens = lens_of(Values(*frame.values, file), *size);
    if (!lens) return refuse(fmt::format("frame \"{}\": {}", frame.name, lens.error().message));
    if (auto added = views.add(frame.name, image_folder / frame.name, frame.pose, *lens); !added)
      return std::unexpected(added.error().within(path.string()));
  }
  auto finished = views.finish();
  if (!finished) return std::unexpected(finished.error().within(path.string()));
  return Scene{std::move(*finished), {}};
}

Expected<void> write_transforms(const fs::path& folder, const std::vector<View>& views,
                                const std::vector<std::string>& names, const std::vector<Eigen::Vector3d>& centers) {
  std::string frames;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Matrix3d& r = views[i].camera.camera_from_world;
    const Eigen::Matrix3d& k = views[i].camera.intrinsics;
    frames += fmt::format(
        "{}{{\"file_path\": {}, \"w\": {}, \"h\": {}, \"fl_x\": {}, \"fl_y\": {}, \"cx\": {}, \"cy\": {},\n",
        i == 0 ? "" : ",\n", Json("images/" + names[i]).dump(), views[i].width, views[i].height, k(0, 0), k(1, 1),
        k(0, 2) + 0.5, k(1, 2) + 0.5);
    frames += "  \"transform_matrix\": [";
    for (int row = 0; row < 3; ++row)
      frames += fmt::format("[{}, {}, {}, {}], ", r(0, row), -r(1, row), -r(2, row), centers[i](row));
    frames += "[0, 0, 0, 1]]}";
  }
  return write_file(folder / "transforms.json",
                    fmt::format("{{\"camera_model\": \"PINHOLE\", \"frames\": [\n{}]}}\n", frames));
}

}  // namespace quorum
