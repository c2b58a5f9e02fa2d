// COLMAP sparse models as they stand in their files: cameras, images and points3D, each as .bin or .txt (Schönberger
// and Frahm 2016; https://colmap.github.io/format.html).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/camera/lens.h"
#include "engine/core/error.h"

namespace quorum {

/// A camera model under its name and number. Its parameters: one or two focal lengths, cx, cy, and the coefficients of
/// its lens, in their order.
struct ColmapCameraModel {
  std::string_view name;
  int id = 0;
  std::size_t focal_count = 0;
  std::size_t coefficient_count = 0;
  Lens::Model lens = Lens::Model::kRadial;

  [[nodiscard]] std::size_t parameter_count() const { return focal_count + 2 + coefficient_count; }
};

/// The camera models that are read: all of COLMAP 4.2's but EQUIRECTANGULAR.
std::span<const ColmapCameraModel> colmap_camera_models();

/// Why a model of this name, or else of this number, is not read, and what helps.
std::string unknown_camera_model(std::string_view name, int id);

struct ColmapCamera {
  std::uint32_t id = 0;
  const ColmapCameraModel* model = nullptr;
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// In COLMAP's order. The center of the top-left pixel is (0.5, 0.5).
  std::vector<double> parameters;
};

/// Where an image shows a point. The center of the top-left pixel is (0.5, 0.5).
struct ColmapObservation {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::uint64_t point_id = 0;
};

struct ColmapImage {
  std::uint32_t id = 0;
  std::array<double, 4> rotation = {1, 0, 0, 0};          ///< quaternion w x y z, world to camera
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< world to camera
  std::uint32_t camera_id = 0;
  std::string name;                             ///< of the file, below the folder of images
  std::vector<ColmapObservation> observations;  ///< those of a point; reading drops the others
};

struct ColmapPoint {
  std::uint64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> color = {0, 0, 0};
  std::vector<std::uint32_t> image_ids;  ///< as in the track: an image may come twice
};

struct ColmapModel {
  std::vector<ColmapCamera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;
  std::size_t lost_sightings = 0;  ///< of points, by images that the files did not hold; they are left out
};

/// The kind of files that a folder holds a model in, ".bin" or ".txt" (cameras and images are there), or empty.
std::string colmap_model_kind(const std::filesystem::path& folder);

/// How many images the model in a folder holds, from the first bytes of images.bin or the lines of images.txt; 0 if
/// there is no model.
std::size_t count_colmap_images(const std::filesystem::path& folder);

/// Reads the model in a folder; .bin is preferred to .txt. A model without points3D has no points; rigs and frames of
/// newer models are not needed, since images hold their poses all the same. Fails (kInput) if a file is absent, cut off
/// or too long, a value is no number, a camera model is unknown, an id comes twice, or an image refers to an absent
/// camera: the message names the file and the line or record. Memory is in proportion to the
/// files' sizes, whatever counts they state.
Expected<ColmapModel> read_colmap_model(const std::filesystem::path& folder);

/// The name of a file and its bytes.
using NamedBytes = std::pair<std::string, std::string>;

/// A model as cameras.bin, images.bin and points3D.bin. The track of a point lists the observations with its id, in the
/// order of the images. Cannot fail.
std::vector<NamedBytes> format_colmap_model(const ColmapModel& model);

/// The same as cameras.txt, images.txt and points3D.txt, with the shortest numbers that read back as they are. Fails
/// (kInput) if the name of an image is empty, or begins or ends with a space, which the files can't say.
Expected<std::vector<NamedBytes>> format_colmap_model_txt(const ColmapModel& model);

/// Writes the files of format_colmap_model. Fails (kInput) if one can't be written.
Expected<void> write_colmap_model(const std::filesystem::path& folder, const ColmapModel& model);

}  // namespace quorum
