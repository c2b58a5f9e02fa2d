// The files of a COLMAP model as .txt: a record a line (an image: two lines), # for comments.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "engine/io/colmap_files.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The fields of one line, taken one after the other; the first that is wrong is kept for the message.
class Fields {
 public:
  Fields(const fs::path& path, int line, std::string_view text)
      : path_(path), line_(line), tokens_(split_tokens(text)) {}

  template <typename T>
  T number(std::string_view name) {
    if (place_ >= tokens_.size()) {
      fail(fmt::format("{} is missing", name));
      return T{};
    }
    const std::string_view token = tokens_[place_++];
    const auto value = parse_number<T>(token);
    if (!value) fail(fmt::format("{} = {} is not a number in range", name, quote_token(token)));
    return value.value_or(T{});
  }
  std::string_view word(std::string_view name) {
    if (place_ < tokens_.size()) return tokens_[place_++];
    fail(fmt::format("{} is missing", name));
    return {};
  }
  [[nodiscard]] std::size_t left() const { return tokens_.size() - place_; }
  /// From the next token to the end of the last one.
  std::string_view rest() {
    if (left() == 0) return {};
    const char* begin = tokens_[place_].data();
    const char* end = tokens_.back().data() + tokens_.back().size();
    place_ = tokens_.size();
    return {begin, static_cast<std::size_t>(end - begin)};
  }
  void fail(std::string message) {
    if (problem_.empty()) problem_ = std::move(message);
  }
  /// The first failure, or that of fields left over.
  [[nodiscard]] Expected<void> done() {
    if (left() > 0) fail(fmt::format("{} fields are left over", left()));
    if (problem_.empty()) return {};
    return failure_at_line(path_, line_, problem_);
  }

 private:
  const fs::path& path_;
  int line_;
  std::vector<std::string_view> tokens_;
  std::size_t place_ = 0;
  std::string problem_;
};

/// The next line that is neither blank nor a comment.
std::optional<std::string_view> next_record(LineReader& lines) {
  auto line = lines.next_filled();
  while (line && (*line)[line->find_first_not_of(kTextSpace)] == '#') line = lines.next_filled();
  return line;
}

/// Parses a file record by record. parse makes one of the fields of its line.
template <typename Record, typename Parse>
Expected<std::vector<Record>> parse_records(const fs::path& path, std::string_view text, const Parse& parse) {
  std::vector<Record> records;
  LineReader lines(text);
  while (const auto line = next_record(lines)) {
    Fields fields(path, lines.number(), *line);
    records.push_back(parse(fields));
    QUORUM_TRY(fields.done());
  }
  return records;
}

ColmapCamera parse_camera(Fields& fields) {
  ColmapCamera camera;
  camera.id = fields.number<std::uint32_t>("CAMERA_ID");
  const std::string_view model = fields.word("MODEL");
  camera.width = fields.number<int>("WIDTH");
  camera.height = fields.number<int>("HEIGHT");
  for (const ColmapCameraModel& known : colmap_camera_models())
    if (known.name == model) camera.model = &known;
  if (camera.model == nullptr) fields.fail(unknown_camera_model(model, -1));
  for (std::size_t i = 0; camera.model != nullptr && i < camera.model->parameter_count(); ++i)
    camera.parameters.push_back(fields.number<double>("a parameter"));
  return camera;
}

ColmapImage parse_image(Fields& fields) {
  ColmapImage image;
  image.id = fields.number<std::uint32_t>("IMAGE_ID");
  for (double& value : image.rotation) value = fields.number<double>("a quaternion's value");
  for (int axis = 0; axis < 3; ++axis) image.translation(axis) = fields.number<double>("a translation's value");
  image.camera_id = fields.number<std::uint32_t>("CAMERA_ID");
  image.name = fields.rest();
  if (image.name.empty()) fields.fail("NAME is missing");
  if (has_control_characters(image.name)) fields.fail("NAME has control characters; rename the image");
  return image;
}

/// The features of an image, those of a point.
std::vector<ColmapObservation> parse_observations(Fields& fields) {
  std::vector<ColmapObservation> observations;
  while (fields.left() > 0) {
    ColmapObservation observation;
    observation.pixel.x() = fields.number<double>("X");
    observation.pixel.y() = fields.number<double>("Y");
    const auto point = fields.number<std::int64_t>("POINT3D_ID");
    observation.point_id = static_cast<std::uint64_t>(point);
    if (point >= 0) observations.push_back(observation);
  }
  return observations;
}

ColmapPoint parse_point(Fields& fields) {
  ColmapPoint point;
  point.id = fields.number<std::uint64_t>("POINT3D_ID");
  for (int axis = 0; axis < 3; ++axis) point.position(axis) = fields.number<double>("a coordinate");
  for (std::uint8_t& channel : point.color) channel = fields.number<std::uint8_t>("a color");
  fields.number<double>("ERROR");
  while (fields.left() > 0) {
    point.image_ids.push_back(fields.number<std::uint32_t>("IMAGE_ID"));
    fields.number<std::uint32_t>("POINT2D_IDX");
  }
  return point;
}

/// Numbers with spaces between, each in the shortest form that reads back as it is.
template <typename Numbers>
std::string spaced(const Numbers& numbers) {
  return fmt::format("{}", fmt::join(numbers.begin(), numbers.end(), " "));
}

}  // namespace

Expected<std::vector<ColmapCamera>> parse_colmap_cameras_txt(const fs::path& path, std::string_view text) {
  return parse_records<ColmapCamera>(path, text, parse_camera);
}

Expected<std::vector<ColmapPoint>> parse_colmap_points_txt(const fs::path& path, std::string_view text) {
  return parse_records<ColmapPoint>(path, text, parse_point);
}

Expected<std::vector<ColmapImage>> parse_colmap_images_txt(const fs::path& path, std::string_view text) {
  std::vector<ColmapImage> images;
  LineReader lines(text);
  while (const auto line = next_record(lines)) {
    Fields fields(path, lines.number(), *line);
    images.push_back(parse_image(fields));
    QUORUM_TRY(fields.done());
    // Blank if the image has no features; editors drop such a line at the end.
    const auto second_line = lines.next();
    Fields features(path, lines.number(), second_line.value_or(""));
    images.back().observations = parse_observations(features);
    QUORUM_TRY(features.done());
  }
  return images;
}

Expected<std::vector<NamedBytes>> format_colmap_model_txt(const ColmapModel& model) {
  std::string cameras = "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  for (const ColmapCamera& camera : model.cameras)
    cameras += fmt::format("{} {} {} {} {}\n", camera.id, camera.model->name, camera.width, camera.height,
                           spaced(camera.parameters));
  std::string images = "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then POINTS2D[] as X Y POINT3D_ID\n";
  std::unordered_map<std::uint64_t, std::string> tracks;
  for (const ColmapImage& image : model.images) {
    if (image.name.empty() || kTextSpace.contains(image.name.front()) || kTextSpace.contains(image.name.back()))
      return failure(ErrorKind::kInput, fmt::format("image {}: a model in text can't say its name {}; rename it",
                                                    image.id, quote_token(image.name)));
    images += fmt::format("{} {} {} {} {}\n", image.id, spaced(image.rotation), spaced(image.translation),
                          image.camera_id, image.name);
    int place = 0;
    const char* separator = "";
    for (const ColmapObservation& seen : image.observations) {
      images += fmt::format("{}{} {}", separator, spaced(seen.pixel), seen.point_id);
      tracks[seen.point_id] += fmt::format(" {} {}", image.id, place++);
      separator = " ";
    }
    images += "\n";
  }
  std::string points = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n";
  for (const ColmapPoint& point : model.points)
    points += fmt::format("{} {} {} 0{}\n", point.id, spaced(point.position), spaced(point.color), tracks[point.id]);
  return std::vector<NamedBytes>{{"cameras.txt", cameras}, {"images.txt", images}, {"points3D.txt", points}};
}

}  // namespace quorum
