#include "engine/io/realitycapture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <numbers>
#include <utility>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The fields of a line; one that has commas stands in quotes.
std::vector<std::string> split_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

/// A line under the names of its columns.
class RegistrationRow {
 public:
  RegistrationRow(const std::vector<std::string>& columns, const std::vector<std::string>& fields)
      : columns_(columns), fields_(fields) {}

  /// 0 for a column that may be absent.
  double number(std::string_view column, bool may_be_absent = false) {
    const auto place = std::ranges::find(columns_, column);
    if (place == columns_.end()) {
      if (!may_be_absent) fail(fmt::format("column {} is missing; export Internal/External camera parameters", column));
      return 0.0;
    }
    const std::string& field = fields_[static_cast<std::size_t>(place - columns_.begin())];
    const auto words = split_tokens(field);
    const auto number = words.size() == 1 ? parse_number<double>(words[0]) : std::nullopt;
    if (!number || !std::isfinite(*number)) fail(fmt::format("{} = {} is no number", column, quote_token(field)));
    return number.value_or(0.0);
  }
  void fail(std::string message) {
    if (problem_.empty()) problem_ = std::move(message);
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  const std::vector<std::string>& columns_;
  const std::vector<std::string>& fields_;
  std::string problem_;
};

Camera parse_pose(RegistrationRow& row) {
  const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis);
  };
  const double heading = row.number("heading");
  const double pitch = row.number("pitch");
  const double roll = row.number("roll");
  // x right, y up, z back, as a camera that looks down upon a map.
  Eigen::Matrix3d world_from_camera = (turn(-heading, Eigen::Vector3d::UnitZ()) *
                                       turn(pitch, Eigen::Vector3d::UnitX()) * turn(roll, Eigen::Vector3d::UnitY()))
                                          .toRotationMatrix();
  world_from_camera.rightCols<2>() *= -1.0;
  Camera camera;
  camera.camera_from_world = world_from_camera.transpose();
  camera.translation =
      translation_of_center(camera.camera_from_world, {row.number("x"), row.number("y"), row.number("alt")});
  return camera;
}

std::function<Lens(ImageSize)> parse_lens(RegistrationRow& row, bool& bends) {
  constexpr double kFilm = 36.0;  // millimeters of the longer side
  const double focal = row.number("f") / kFilm;
  const Eigen::Vector2d shift = Eigen::Vector2d{row.number("px", true), row.number("py", true)} / kFilm;
  std::array<double, 4> k{};
  for (std::size_t i = 0; i < 4; ++i) k[i] = row.number(fmt::format("k{}", i + 1), true);
  for (const char* tangential : {"t1", "t2"})
    if (row.number(tangential, true) != 0.0)
      row.fail(
          fmt::format("{} is not 0, and its meaning is not documented; export with a distortion model without "
                      "tangential terms (Brown3 or Brown4), or undistorted photographs",
                      tangential));
  bends = bends || std::ranges::any_of(k, [](double value) { return value != 0.0; });
  return [=](ImageSize size) {
    const double longer = std::max(size.width, size.height);
    Lens lens;
    lens.width = size.width;
    lens.height = size.height;
    lens.focal.setConstant(focal * longer);
    lens.principal = Eigen::Vector2d((size.width - 1) / 2.0, (size.height - 1) / 2.0) + longer * shift;
    lens.coefficients = {k[0], k[1], 0, 0, k[2], 0, 0, 0, k[3]};
    return lens;
  };
}

}  // namespace

bool is_realitycapture_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(16, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.starts_with("#name,") || head.starts_with("#cameras ") || head.starts_with("\xef\xbb\xbf#name,");
}

Expected<Scene> read_realitycapture(const fs::path& path, const fs::path& images) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  SfmModel model{path};
  std::vector<std::string> columns;
  bool bends = false;
  LineReader lines(text);
  while (const auto line = lines.next_filled()) {
    if (line->starts_with("#cameras ")) continue;
    const std::vector<std::string> fields = split_fields(*line);
    if (columns.empty()) {
      columns = fields;
      if (columns[0] != "#name") return failure_at_line(path, lines.number(), "expected the columns, #name first");
      continue;
    }
    if (fields.size() != columns.size())
      return failure_at_line(path, lines.number(),
                             fmt::format("expected {} columns, found {}", columns.size(), fields.size()));
    RegistrationRow row(columns, fields);
    const Camera pose = parse_pose(row);
    auto lens = parse_lens(row, bends);
    if (!row.problem().empty()) return failure_at_line(path, lines.number(), row.problem());
    model.images.push_back({fields[0], pose, std::move(lens)});
  }
  if (bends)
    model.notes.emplace_back("k1 to k4 are taken for Brown's distortion model, since the file does not name one");
  return make_sfm_scene(std::move(model), photograph_folders(path, images));
}

}  // namespace quorum
