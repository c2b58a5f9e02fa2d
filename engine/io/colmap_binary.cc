// The files of a COLMAP model as .bin: little-endian records without padding.
#include <fmt/format.h>

#include <climits>

#include "engine/io/byte_reader.h"
#include "engine/io/colmap_files.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoPoint = ~std::uint64_t{0};

std::unexpected<Error> record_failure(const fs::path& path, std::string_view record, std::uint64_t index,
                                      std::string_view message) {
  return failure(ErrorKind::kInput, fmt::format("{}: {} {}: {}", path.string(), record, index + 1, message));
}

/// Parses all records of a file with parse(reader, index). record_bytes: what each takes at least.
template <typename Record, typename Parse>
Expected<std::vector<Record>> parse_records(const fs::path& path, std::string_view bytes, std::string_view name,
                                            std::size_t record_bytes, const Parse& parse) {
  ByteReader reader(bytes);
  const std::uint64_t count = reader.next_count(record_bytes);
  if (reader.failed())
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is shorter ({} bytes) than its count of records says; copy it again", path.string(),
                               bytes.size()));
  std::vector<Record> records;
  records.reserve(count);
  for (std::uint64_t index = 0; index < count; ++index) {
    Expected<Record> record = parse(reader, index);
    if (!record) return std::unexpected(record.error());
    if (reader.failed()) return record_failure(path, name, index, "is cut off or damaged; copy the file again");
    records.push_back(std::move(*record));
  }
  if (reader.left() > 0)
    return failure(ErrorKind::kInput, fmt::format("{}: {} bytes follow the {} records that it counts; copy it again",
                                                  path.string(), reader.left(), count));
  return records;
}

}  // namespace

Expected<std::vector<ColmapCamera>> parse_colmap_cameras_bin(const fs::path& path, std::string_view bytes) {
  const auto parse = [&path](ByteReader& reader, std::uint64_t index) -> Expected<ColmapCamera> {
    ColmapCamera camera;
    camera.id = reader.next<std::uint32_t>();
    const int model = reader.next<std::int32_t>();
    const auto width = reader.next<std::uint64_t>();
    const auto height = reader.next<std::uint64_t>();
    if (reader.failed()) return camera;
    for (const ColmapCameraModel& known : colmap_camera_models())
      if (known.id == model) camera.model = &known;
    if (camera.model == nullptr) return record_failure(path, "camera", index, unknown_camera_model({}, model));
    if (width > INT_MAX || height > INT_MAX)
      return record_failure(path, "camera", index, fmt::format("a size of {} x {} pixels is absurd", width, height));
    camera.width = static_cast<int>(width);
    camera.height = static_cast<int>(height);
    for (std::size_t i = 0; i < camera.model->parameter_count(); ++i)
      camera.parameters.push_back(reader.next<double>());
    return camera;
  };
  return parse_records<ColmapCamera>(path, bytes, "camera", 4 + 4 + 8 + 8 + 3 * 8, parse);
}

Expected<std::vector<ColmapImage>> parse_colmap_images_bin(const fs::path& path, std::string_view bytes) {
  const auto parse = [&path](ByteReader& reader, std::uint64_t index) -> Expected<ColmapImage> {
    ColmapImage image;
    image.id = reader.next<std::uint32_t>();
    for (double& value : image.rotation) value = reader.next<double>();
    for (int axis = 0; axis < 3; ++axis) image.translation(axis) = reader.next<double>();
    image.camera_id = reader.next<std::uint32_t>();
    image.name = reader.next_string();
    if (has_control_characters(image.name))
      return record_failure(path, "image", index, "its name has control characters; copy the file again");
    const std::uint64_t count = reader.next_count(2 * 8 + 8);
    for (std::uint64_t i = 0; i < count; ++i) {
      ColmapObservation observation;
      observation.pixel.x() = reader.next<double>();
      observation.pixel.y() = reader.next<double>();
      observation.point_id = reader.next<std::uint64_t>();
      if (observation.point_id != kNoPoint) image.observations.push_back(observation);
    }
    return image;
  };
  return parse_records<ColmapImage>(path, bytes, "image", 4 + 7 * 8 + 4 + 1 + 8, parse);
}

Expected<std::vector<ColmapPoint>> parse_colmap_points_bin(const fs::path& path, std::string_view bytes) {
  const auto parse = [](ByteReader& reader, std::uint64_t) -> Expected<ColmapPoint> {
    ColmapPoint point;
    point.id = reader.next<std::uint64_t>();
    for (int axis = 0; axis < 3; ++axis) point.position(axis) = reader.next<double>();
    for (std::uint8_t& channel : point.color) channel = reader.next<std::uint8_t>();
    reader.next<double>();  // its error
    const std::uint64_t length = reader.next_count(2 * 4);
    point.image_ids.reserve(length);
    for (std::uint64_t i = 0; i < length; ++i) {
      point.image_ids.push_back(reader.next<std::uint32_t>());
      reader.next<std::uint32_t>();  // the observation in that image
    }
    return point;
  };
  return parse_records<ColmapPoint>(path, bytes, "point", 8 + 3 * 8 + 3 + 8 + 8, parse);
}

}  // namespace quorum
