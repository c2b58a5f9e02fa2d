#include "engine/io/transforms.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/find_photograph.h"
#include "engine/io/image_size.h"
#include "engine/io/json_values.h"
#include "engine/io/ply.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"
#include "engine/io/transforms_lens.h"
#include "engine/io/view_list.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The numbers of a transform_matrix, whose last row may be missing.
Expected<Eigen::Matrix4d> matrix_of(const Json& frame) {
  const auto no_matrix = failure(ErrorKind::kInput, "transform_matrix is no 4 x 4 matrix of numbers");
  const auto rows = frame.find("transform_matrix");
  if (rows == frame.end() || !rows->is_array() || rows->size() < 3 || rows->size() > 4) return no_matrix;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (int row = 0; row < static_cast<int>(rows->size()); ++row) {
    const auto values = JsonObject::vector_of<4>((*rows)[static_cast<std::size_t>(row)]);
    if (!values) return no_matrix;
    matrix.row(row) = *values;
  }
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    return failure(ErrorKind::kInput,
                   "the last row of its transform_matrix is not 0 0 0 1; divide by its last number, "
                   "or transpose it if it is written column by column");
  return matrix;
}

/// Camera to world in OpenGL's axes becomes world to camera in ours. A scale of the axes, as programs export that scale
/// the camera as an object, moves no ray; scaled says whether there was one.
Expected<Camera> pose_of(const Json& frame, bool& scaled) {
  constexpr double kTolerance = 1e-3;  // of camera_defect
  QUORUM_ASSIGN(const Eigen::Matrix4d matrix, matrix_of(frame));
  Eigen::Matrix3d world_from_camera = matrix.topLeftCorner<3, 3>();
  const Eigen::RowVector3d lengths = world_from_camera.colwise().norm();
  scaled = lengths.minCoeff() > 0.0 && (lengths.array() - 1.0).abs().maxCoeff() > kTolerance / 4;
  if (scaled)
    for (int column = 0; column < 3; ++column) world_from_camera.col(column) /= lengths(column);
  if (world_from_camera.determinant() < 0)
    return failure(ErrorKind::kInput,
                   "its transform_matrix mirrors, as that of left-handed coordinates does (Unity, "
                   "Unreal): turn an axis of the world around, and the same axis of the cameras");
  world_from_camera.col(1) *= -1.0;
  world_from_camera.col(2) *= -1.0;
  Camera camera;
  camera.camera_from_world = world_from_camera.transpose();
  camera.translation = translation_of_center(camera.camera_from_world, matrix.topRightCorner<3, 1>());
  return camera;
}

/// A frame with its photograph, which may be absent, and its mask.
struct Frame {
  std::string name;
  fs::path image;
  fs::path mask;
  Camera pose;
  const Json* values = nullptr;
};

Expected<Frame> parse_frame(const Json& values, const fs::path& folder, const fs::path& images, bool& scaled) {
  const auto refuse = [](std::string_view message) { return failure(ErrorKind::kInput, std::string(message)); };
  const auto path = values.is_object() ? values.find("file_path") : values.end();
  if (!values.is_object() || path == values.end() || !path->is_string()) return refuse("has no file_path");
  Frame frame;
  frame.values = &values;
  const auto text = path->get<std::string>();
  if (has_control_characters(text)) return refuse("its file_path has control characters");
  frame.name = fs::path(text).lexically_normal().string();
  frame.image = images.empty() ? find_photograph(folder, frame.name) : find_photograph_by_end(images, frame.name);
  if (const std::string found = frame.image.extension().string(); fs::path(frame.name).extension().empty())
    frame.name += found;
  QUORUM_ASSIGN(frame.pose, pose_of(values, scaled));
  if (const auto mask = values.find("mask_path"); mask != values.end() && !mask->is_null()) {
    if (!mask->is_string()) return refuse("its mask_path is no text");
    frame.mask = find_photograph(folder, mask->get<std::string>());
    if (frame.mask.empty())
      return refuse(fmt::format("its mask_path {} is not there; add it, or remove the field",
                                quote_token(mask->get<std::string>())));
  }
  return frame;
}

Expected<void> read_points(const Json& file, const fs::path& folder, Scene& scene) {
  const auto name = file.find("ply_file_path");
  if (name == file.end() || !name->is_string()) return {};
  const fs::path path = folder / name->get<std::string>();
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    scene.notes.push_back(
        fmt::format("ply_file_path {} is not there; its points are not used", quote_token(name->get<std::string>())));
    return {};
  }
  QUORUM_ASSIGN(const auto cloud, read_ply(path));
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(cloud.vertices.size());
  for (const Vertex& vertex : cloud.vertices) positions.push_back(vertex.position.cast<double>() + cloud.offset);
  scene.points = points_before(scene.views, positions);
  return {};
}

/// The frames of the file, sorted by name; notes tell of scales and of fields that are not used.
Expected<std::vector<Frame>> parse_frames(const Json& file, const fs::path& folder, const fs::path& images,
                                          std::vector<std::string>& notes) {
  const auto list = file.find("frames");
  if (list == file.end() || !list->is_array()) return failure(ErrorKind::kInput, "has no list \"frames\"");
  std::vector<Frame> frames;
  std::set<std::string> unused;
  add_unused_fields(file, FieldPlace::kFile, unused);
  std::size_t scaled_count = 0;
  for (std::size_t i = 0; i < list->size(); ++i) {
    bool scaled = false;
    auto frame = parse_frame((*list)[i], folder, images, scaled);
    if (!frame) return failure(ErrorKind::kInput, fmt::format("frame {}: {}", i, frame.error().message));
    scaled_count += scaled ? 1 : 0;
    add_unused_fields(*frame->values, FieldPlace::kFrame, unused);
    frames.push_back(std::move(*frame));
  }
  std::ranges::sort(frames, {}, &Frame::name);
  if (scaled_count > 0)
    notes.push_back(
        fmt::format("the scale in the transform_matrix of {} frames means nothing for a camera, and is taken "
                    "off",
                    scaled_count));
  if (!unused.empty()) notes.push_back(fmt::format("transforms.json: not used: {}", fmt::join(unused, ", ")));
  return frames;
}

}  // namespace

Expected<Scene> read_transforms(const fs::path& folder, const fs::path& images) {
  const fs::path path = folder / "transforms.json";
  const auto refuse = [&path](const Error& error) { return std::unexpected(error.within(path.string())); };
  QUORUM_ASSIGN(const auto text, read_file(path));
  QUORUM_ASSIGN(const Json file, parse_json(path, text));
  if (!file.is_object()) return path_failure(path, "is no JSON object; check its syntax");
  std::vector<std::string> notes;
  const auto frames = parse_frames(file, folder, images, notes);
  if (!frames) return refuse(frames.error());

  ViewList list;
  std::vector<fs::path> masks;
  for (const Frame& frame : *frames) {
    ImageSize size;
    if (!frame.image.empty()) {
      const auto found = read_image_size(frame.image);
      if (!found) return refuse(found.error());
      size = *found;
    }
    const auto lens = lens_of_frame(*frame.values, file, size);
    if (!lens) return refuse(lens.error().within(fmt::format("frame \"{}\"", frame.name)));
    const auto added = list.add(frame.name, frame.image, frame.pose, *lens);
    if (!added) return refuse(added.error());
    if (*added >= 0) masks.push_back(frame.mask);
  }
  auto scene = list.finish();
  if (!scene) return refuse(scene.error());
  const auto mask_count = std::ranges::count_if(masks, [](const fs::path& mask) { return !mask.empty(); });
  if (mask_count > 0) notes.push_back(fmt::format("{} frames have a mask (mask_path)", mask_count));
  for (std::size_t i = 0; i < masks.size(); ++i)
    if (!masks[i].empty()) scene->views[i].mask_path = masks[i];
  QUORUM_TRY(read_points(file, folder, *scene));
  scene->notes.insert(scene->notes.begin(), notes.begin(), notes.end());
  return scene;
}

Expected<void> write_transforms(OutputFolder& output, const std::vector<View>& views,
                                const std::vector<std::string>& names, const std::vector<Eigen::Vector3d>& centers,
                                const std::vector<std::string>& members) {
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
    frames += "[0, 0, 0, 1]]";
    if (!members.empty()) frames += members[i];
    frames += '}';
  }
  return output.write("transforms.json",
                      fmt::format("{{\"camera_model\": \"PINHOLE\", \"frames\": [\n{}]}}\n", frames));
}

}  // namespace quorum
