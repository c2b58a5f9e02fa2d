#include "engine/io/colmap_model.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <unordered_map>
#include <unordered_set>

#include "engine/io/colmap_files.h"
#include "engine/io/file.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

using Model = Lens::Model;

constexpr ColmapCameraModel kModels[] = {{"SIMPLE_PINHOLE", 0, 1, 0, Model::kRadial},
                                         {"PINHOLE", 1, 2, 0, Model::kRadial},
                                         {"SIMPLE_RADIAL", 2, 1, 1, Model::kRadial},
                                         {"RADIAL", 3, 1, 2, Model::kRadial},
                                         {"OPENCV", 4, 2, 4, Model::kRadial},
                                         {"OPENCV_FISHEYE", 5, 2, 4, Model::kFisheye},
                                         {"FULL_OPENCV", 6, 2, 8, Model::kRadial},
                                         {"FOV", 7, 2, 1, Model::kFov},
                                         {"SIMPLE_RADIAL_FISHEYE", 8, 1, 1, Model::kFisheye},
                                         {"RADIAL_FISHEYE", 9, 1, 2, Model::kFisheye},
                                         {"THIN_PRISM_FISHEYE", 10, 2, 8, Model::kThinPrismFisheye},
                                         {"RAD_TAN_THIN_PRISM_FISHEYE", 11, 2, 12, Model::kRadTanThinPrismFisheye},
                                         {"SIMPLE_DIVISION", 12, 1, 1, Model::kDivision},
                                         {"DIVISION", 13, 2, 1, Model::kDivision},
                                         {"SIMPLE_FISHEYE", 14, 1, 0, Model::kFisheye},
                                         {"FISHEYE", 15, 2, 0, Model::kFisheye},
                                         {"EUCM", 16, 2, 2, Model::kEucm}};

template <typename Record>
using Parser = Expected<std::vector<Record>> (*)(const fs::path&, std::string_view);

template <typename Record>
Expected<std::vector<Record>> read_records(const fs::path& path, Parser<Record> parse) {
  QUORUM_ASSIGN(const auto bytes, read_file(path));
  return parse(path, bytes);
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
  for (const ColmapPoint& point : model.points)
    if (!points.insert(point.id).second)
      return path_failure(folder / ("points3D" + kind), fmt::format("holds point {} twice", point.id));
  return {};
}

/// Drops the sightings by images that were removed from the model.
void drop_lost_sightings(ColmapModel& model) {
  std::unordered_set<std::uint32_t> images;
  for (const ColmapImage& image : model.images) images.insert(image.id);
  for (ColmapPoint& point : model.points)
    model.lost_sightings +=
        std::erase_if(point.image_ids, [&images](std::uint32_t image) { return !images.contains(image); });
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

std::string unknown_camera_model(std::string_view name, int id) {
  constexpr int kEquirectangular = 17;
  if (name == "EQUIRECTANGULAR" || (name.empty() && id == kEquirectangular))
    return "its model EQUIRECTANGULAR is a panorama, which no pinhole camera shows; cut the panoramas into perspective "
           "views first (pycolmap's example panorama_sfm.py does)";
  std::string known;
  for (const ColmapCameraModel& model : kModels) known += fmt::format("{}{}", known.empty() ? "" : ", ", model.name);
  return fmt::format("its model {} is not known; use image_undistorter, or one of {}",
                     name.empty() ? std::to_string(id) : quote_token(name), known);
}

std::size_t count_colmap_images(const fs::path& folder) {
  const std::string kind = colmap_model_kind(folder);
  if (kind.empty()) return 0;
  if (kind == ".bin") {
    std::ifstream file(folder / "images.bin", std::ios::binary);
    std::uint64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), sizeof(count));
    return file ? count : 0;
  }
  const auto text = read_file(folder / "images.txt");
  if (!text) return 0;
  std::size_t count = 0;
  LineReader lines(*text);
  for (auto line = lines.next_filled(); line; line = lines.next_filled()) {
    if ((*line)[line->find_first_not_of(kTextSpace)] == '#') continue;
    ++count;
    lines.next();
  }
  return count;
}

std::string colmap_model_kind(const fs::path& folder) {
  for (const char* kind : {".bin", ".txt"})
    if (is_file(folder / (std::string("cameras") + kind)) && is_file(folder / (std::string("images") + kind)))
      return kind;
  return {};
}

Expected<ColmapModel> read_colmap_model(const fs::path& folder) {
  const std::string kind = colmap_model_kind(folder);
  if (kind.empty()) return path_failure(folder, "holds no COLMAP model (cameras and images, as .bin or .txt)");
  const bool binary = kind == ".bin";
  QUORUM_ASSIGN(auto cameras, read_records<ColmapCamera>(folder / ("cameras" + kind),
                                                         binary ? parse_colmap_cameras_bin : parse_colmap_cameras_txt));
  QUORUM_ASSIGN(auto images, read_records<ColmapImage>(folder / ("images" + kind),
                                                       binary ? parse_colmap_images_bin : parse_colmap_images_txt));
  ColmapModel model{std::move(cameras), std::move(images), {}, 0};
  const fs::path points_path = folder / ("points3D" + kind);
  std::error_code ignored;
  if (fs::exists(points_path, ignored)) {
    QUORUM_ASSIGN(auto points,
                  read_records<ColmapPoint>(points_path, binary ? parse_colmap_points_bin : parse_colmap_points_txt));
    model.points = std::move(points);
  }
  QUORUM_TRY(check_references(folder, kind, model));
  drop_lost_sightings(model);
  return model;
}

std::vector<NamedBytes> format_colmap_model(const ColmapModel& model) {
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
  return {{"cameras.bin", cameras.bytes()}, {"images.bin", images.bytes()}, {"points3D.bin", points.bytes()}};
}

Expected<void> write_colmap_model(const fs::path& folder, const ColmapModel& model) {
  for (const auto& [name, bytes] : format_colmap_model(model)) QUORUM_TRY(write_file(folder / name, bytes));
  return {};
}

}  // namespace quorum
