#include "engine/io/colmap_model.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include "engine/io/colmap_files.h"
#include "engine/io/file.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr ColmapCameraModel kModels[] = {{"SIMPLE_PINHOLE", 0, 1, 0, false}, {"PINHOLE", 1, 2, 0, false},
                                         {"SIMPLE_RADIAL", 2, 1, 1, false},  {"RADIAL", 3, 1, 2, false},
                                         {"OPENCV", 4, 2, 4, false},         {"OPENCV_FISHEYE", 5, 2, 4, true},
                                         {"FULL_OPENCV", 6, 2, 8, false},    {"SIMPLE_RADIAL_FISHEYE", 8, 1, 1, true},
                                         {"RADIAL_FISHEYE", 9, 1, 2, true}};

template <typename Record>
using Parser = Expected<std::vector<Record>> (*)(const fs::path&, std::string_view);

template <typename Record>
Expected<std::vector<Record>> read_records(const fs::path& path, Parser<Record> parse) {
  const auto bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  return parse(path, *bytes);
}

/// What refers to what must be there, and each id once.
Expected<void> check_references(const fs::path& folder, const std::string& kind, const ColmapModel& model) {
  std::unordered_set<std::uint32_t> cameras;
  for (const ColmapCamera& camera : model.cameras)
    if (!cameras.insert(camera.id).second)
      return path_failure(folder / ("cameras" + kind), fmt::format("holds camera {} twice", camera.id));
  std::unordered_set<std::uint32_t> images;
  for (const ColmapImage& image : model.images) {
    const fs::path path = folder / ("images" + kind);
    if (!images.insert(image.id).second) return path_failure(path, fmt::format("holds image {} twice", image.id));
    if (!cameras.contains(image.camera_id))
      return path_failure(path, fmt::format("image {} refers to camera {}, which cameras{} does not hold", image.id,
                                            image.camera_id, kind));
  }
  std::unordered_set<std::uint64_t> points;
  for (const ColmapPoint& point : model.points) {
    const fs::path path = folder / ("points3D" + kind);
    if (!points.insert(point.id).second) return path_failure(path, fmt::format("holds point {} twice", point.id));
    for (const std::uint32_t image : point.image_ids)
      if (!images.contains(image))
        return path_failure(
            path, fmt::format("point {} refers to image {}, which images{} does not hold", point.id, image, kind));
  }
  return {};
}

/// Appends numbers as they stand in memory, little-endian.
class ByteWriter {
 public:
  template <typename T>
  void add(T value) {
    static_assert(std::endian::native == std::endian::little && std::is_arithmetic_v<T>);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
  }
  void add_string(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

std::span<const ColmapCameraModel> colmap_camera_models() { return kModels; }

std::string colmap_model_kind(const fs::path& folder) {
  std::error_code ignored;
  for (const char* kind : {".bin", ".txt"})
    if (fs::is_regular_file(folder / (std::string("cameras") + kind), ignored) &&
        fs::is_regular_file(folder / (std::string("images") + kind), ignored))
      return kind;
  return {};
}

Expected<ColmapModel> read_colmap_model(const fs::path& folder) {
  const std::string kind = colmap_model_kind(folder);
  if (kind.empty()) return path_failure(folder, "holds no COLMAP model (cameras and images, as .bin or .txt)");
  const bool binary = kind == ".bin";
  auto cameras = read_records<ColmapCamera>(folder / ("cameras" + kind),
                                            binary ? parse_colmap_cameras_bin : parse_colmap_cameras_txt);
  if (!cameras) return std::unexpected(cameras.error());
  auto images =
      read_records<ColmapImage>(folder / ("images" + kind), binary ? parse_colmap_images_bin : parse_colmap_images_txt);
  if (!images) return std::unexpected(images.error());
  ColmapModel model{std::move(*cameras), std::move(*images), {}};
  const fs::path points_path = folder / ("points3D" + kind);
  std::error_code ignored;
  if (fs::exists(points_path, ignored)) {
    auto points = read_records<ColmapPoint>(points_path, binary ? parse_colmap_points_bin : parse_colmap_points_txt);
    if (!points) return std::unexpected(points.error());
    model.points = std::move(*points);
  }
  if (auto checked = check_references(folder, kind, model); !checked) return std::unexpected(checked.error());
  return model;
}

Expected<void> write_colmap_model(const fs::path& folder, const ColmapModel& model) {
  ByteWriter cameras;
  cameras.add<std::uint64_t>(model.cameras.size());
  for (const ColmapCamera& camera : model.cameras) {
    cameras.add<std::uint32_t>(camera.id);
    cameras.add<std::int32_t>(camera.model->id);
    cameras.add<std::uint64_t>(static_cast<std::uint64_t>(camera.width));
    cameras.add<std::uint64_t>(static_cast<std::uint64_t>(camera.height));
    for (const double parameter : camera.parameters) cameras.add<double>(parameter);
  }

  struct Sighting {
    std::uint32_t image_id = 0;
    std::uint32_t place = 0;
  };
  std::unordered_map<std::uint64_t, std::vector<Sighting>> tracks;
  ByteWriter images;
  images.add<std::uint64_t>(model.images.size());
  for (const ColmapImage& image : model.images) {
    images.add<std::uint32_t>(image.id);
    for (const double value : image.rotation) images.add<double>(value);
    for (int axis = 0; axis < 3; ++axis) images.add<double>(image.translation(axis));
    images.add<std::uint32_t>(image.camera_id);
    images.add_string(image.name);
    images.add<std::uint64_t>(image.observations.size());
    std::uint32_t place = 0;
    for (const ColmapObservation& observation : image.observations) {
      images.add<double>(observation.pixel.x());
      images.add<double>(observation.pixel.y());
      images.add<std::uint64_t>(observation.point_id);
      tracks[observation.point_id].push_back({image.id, place++});
    }
  }

  ByteWriter points;
  points.add<std::uint64_t>(model.points.size());
  for (const ColmapPoint& point : model.points) {
    points.add<std::uint64_t>(point.id);
    for (int axis = 0; axis < 3; ++axis) points.add<double>(point.position(axis));
    for (const std::uint8_t channel : point.color) points.add<std::uint8_t>(channel);
    points.add<double>(0.0);  // its error
    const std::vector<Sighting>& track = tracks[point.id];
    points.add<std::uint64_t>(track.size());
    for (const Sighting& sighting : track) {
      points.add<std::uint32_t>(sighting.image_id);
      points.add<std::uint32_t>(sighting.place);
    }
  }
  for (const auto& [name, writer] :
       {std::pair{"cameras.bin", &cameras}, {"images.bin", &images}, {"points3D.bin", &points}})
    if (auto written = write_file(folder / name, writer->bytes()); !written) return written;
  return {};
}

}  // namespace quorum
