#include "engine/io/opensfm.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "engine/io/file.h"
#include "engine/io/json_values.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Expected<Lens> parse_lens(const Json& json) {
  JsonObject camera(json);
  std::string type = camera.text_or_empty("projection_type");
  if (type.empty()) type = "perspective";
  Lens lens;
  lens.width = static_cast<int>(std::clamp(camera.number("width"), 0.0, 1e6));
  lens.height = static_cast<int>(std::clamp(camera.number("height"), 0.0, 1e6));
  const double size = std::max(lens.width, lens.height);
  const bool one_focal = type == "perspective" || type == "fisheye";
  lens.focal = {size * camera.number(one_focal ? "focal" : "focal_x"),
                size * camera.number(one_focal ? "focal" : "focal_y")};
  lens.principal = {(lens.width - 1) / 2.0 + size * camera.number_or("c_x", 0.0),
                    (lens.height - 1) / 2.0 + size * camera.number_or("c_y", 0.0)};
  const auto k = [&camera](const char* name) { return camera.number_or(name, 0.0); };
  if (type == "perspective" || type == "simple_radial" || type == "radial") {
    lens.coefficients = {k("k1"), k("k2")};
  } else if (type == "brown") {
    lens.coefficients = {k("k1"), k("k2"), k("p1"), k("p2"), k("k3")};
  } else if (type == "fisheye" || type == "fisheye_opencv") {
    lens.model = Lens::Model::kFisheye;
    lens.coefficients = {k("k1"), k("k2"), k("k3"), k("k4")};
  } else if (type == "fisheye62" && k("k5") == 0.0 && k("k6") == 0.0) {
    lens.model = Lens::Model::kThinPrismFisheye;
    lens.coefficients = {k("k1"), k("k2"), k("p1"), k("p2"), k("k3"), k("k4")};
  } else {
    return failure(ErrorKind::kInput,
                   fmt::format("its projection_type {} is not read; run opensfm undistort and give the folder "
                               "undistorted, which cuts panoramas into views, too",
                               quote_token(type)));
  }
  QUORUM_TRY(camera.done());
  return lens;
}

/// Members of an object under a name, by their own names.
const Json& members(const Json& json, const char* name) {
  static const Json kNone = Json::object();
  const Json* found = JsonObject(json).find(name);
  return found != nullptr && found->is_object() ? *found : kNone;
}

/// The reconstruction with the most shots; told if it was a choice.
const Json* choose_largest(const Json& file, std::vector<std::string>& notes) {
  const Json* best = nullptr;
  for (const Json& candidate : file)
    if (best == nullptr || members(candidate, "shots").size() > members(*best, "shots").size()) best = &candidate;
  if (best != nullptr && file.size() > 1)
    notes.push_back(fmt::format("of {} reconstructions the largest is taken, with {} images", file.size(),
                                members(*best, "shots").size()));
  return best;
}

Expected<void> add_shots(const Json& reconstruction, SfmModel& model) {
  std::map<std::string, Lens> lenses;
  for (const auto& [name, camera] : members(reconstruction, "cameras").items()) {
    const auto lens = parse_lens(camera);
    if (!lens) return std::unexpected(lens.error().within("camera " + quote_token(name)));
    lenses.emplace(name, *lens);
  }
  for (const auto& [name, json] : members(reconstruction, "shots").items()) {
    JsonObject shot(json);
    const auto lens = lenses.find(shot.text("camera"));
    if (lens == lenses.end()) shot.fail("camera", "one of the file's cameras");
    const Eigen::Vector3d turn = shot.vector<3>("rotation");
    Camera pose;
    if (turn.norm() > 0) pose.camera_from_world = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    pose.translation = shot.vector<3>("translation");
    if (auto done = shot.done(); !done) return std::unexpected(done.error().within("shot " + quote_token(name)));
    model.images.push_back({name, pose, fixed_lens(lens->second)});
  }
  return {};
}

Expected<std::map<std::string, Eigen::Vector3d>> parse_points(const Json& reconstruction) {
  std::map<std::string, Eigen::Vector3d> points;
  for (const auto& [name, json] : members(reconstruction, "points").items()) {
    JsonObject point(json);
    points.emplace(name, point.vector<3>("coordinates"));
    if (auto done = point.done(); !done) return std::unexpected(done.error().within("point " + quote_token(name)));
  }
  return points;
}

/// Lines "image track feature x y ..." joined by tabs, maybe after one that names the version.
Expected<void> read_tracks(const fs::path& path, const std::map<std::string, Eigen::Vector3d>& points,
                           SfmModel& model) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  std::map<std::string_view, int> image_of;
  for (std::size_t i = 0; i < model.images.size(); ++i) image_of.emplace(model.images[i].name, static_cast<int>(i));
  std::map<std::string, SparsePoint> seen;
  LineReader lines(text);
  while (const auto line = lines.next_filled()) {
    if (lines.number() == 1 && line->starts_with("OPENSFM_TRACKS_VERSION")) continue;
    const std::size_t first = line->find('\t');
    const std::size_t second = first == std::string_view::npos ? first : line->find('\t', first + 1);
    if (second == std::string_view::npos)
      return failure_at_line(path, lines.number(), "expected image, track and feature, joined by tabs");
    const auto image = image_of.find(line->substr(0, first));
    const std::string track(line->substr(first + 1, second - first - 1));
    const auto point = points.find(track);
    if (image == image_of.end() || point == points.end()) continue;
    seen.try_emplace(track, SparsePoint{point->second, {}}).first->second.views.push_back(image->second);
  }
  for (auto& [track, point] : seen) model.points.push_back(std::move(point));
  return {};
}

}  // namespace

Expected<Scene> read_opensfm(const fs::path& path, const fs::path& images) {
  const auto refuse = [&path](const Error& error) { return std::unexpected(error.within(path.string())); };
  QUORUM_ASSIGN(const auto text, read_file(path));
  QUORUM_ASSIGN(const Json file, parse_json(path, text, "list of reconstructions"));
  if (!file.is_array()) return path_failure(path, "is no JSON list of reconstructions; check its syntax");
  SfmModel model{path};
  const Json* reconstruction = choose_largest(file, model.notes);
  if (reconstruction == nullptr) return path_failure(path, "holds no reconstruction; run opensfm reconstruct");
  if (const auto added = add_shots(*reconstruction, model); !added) return refuse(added.error());
  const auto points = parse_points(*reconstruction);
  if (!points) return refuse(points.error());
  const fs::path tracks = path.parent_path() / "tracks.csv";
  std::error_code ignored;
  const bool has_tracks = fs::exists(tracks, ignored);
  if (has_tracks) QUORUM_TRY(read_tracks(tracks, *points, model));
  QUORUM_ASSIGN(auto scene, make_sfm_scene(std::move(model), photograph_folders(path, images)));
  if (has_tracks) return scene;
  std::vector<Eigen::Vector3d> positions;
  for (const auto& [name, position] : *points) positions.push_back(position);
  scene.points = points_before(scene.views, positions);
  return scene;
}

}  // namespace quorum
