#include "tests/support/colmap_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "engine/io/write_image.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

std::vector<double> parameters_of(const ColmapCameraModel& model, int width) {
  // Shown by name, so that a mistake in the table of models can't hide.
  static const std::map<std::string_view, std::vector<double>> kCoefficients = {
      {"SIMPLE_PINHOLE", {}},
      {"PINHOLE", {}},
      {"SIMPLE_RADIAL", {-0.1}},
      {"RADIAL", {-0.1, 0.02}},
      {"OPENCV", {-0.1, 0.02, 0.002, -0.003}},
      {"OPENCV_FISHEYE", {0.02, -0.01, 0.004, -0.001}},
      {"FULL_OPENCV", {0.1, 0.02, 0.002, -0.003, 0.001, 0.2, 0.01, 0.002}},
      {"SIMPLE_RADIAL_FISHEYE", {0.03}},
      {"RADIAL_FISHEYE", {0.03, -0.01}},
      {"FOV", {0.9}},
      {"THIN_PRISM_FISHEYE", {0.02, -0.01, 0.002, -0.003, 0.004, -0.001, 0.003, -0.002}},
      {"RAD_TAN_THIN_PRISM_FISHEYE",
       {0.02, -0.01, 0.004, 0.002, -0.001, 0.0005, 0.002, -0.003, 0.003, -0.001, -0.002, 0.001}},
      {"SIMPLE_DIVISION", {-0.2}},
      {"DIVISION", {0.1}},
      {"SIMPLE_FISHEYE", {}},
      {"FISHEYE", {}},
      {"EUCM", {0.6, 1.1}},
  };
  std::vector<double> parameters = {70.0};
  if (model.focal_count == 2) parameters.push_back(72.0);
  parameters.push_back(width / 2.0 + 1.5);
  parameters.push_back(23.0);
  const auto& coefficients = kCoefficients.at(model.name);
  parameters.insert(parameters.end(), coefficients.begin(), coefficients.end());
  return parameters;
}

/// COLMAP's documentation of its camera models, written out for each.
Eigen::Vector2d project(const ColmapCamera& camera, const Eigen::Vector3d& point) {
  const double u = point.x() / point.z();
  const double v = point.y() / point.z();
  const double r2 = u * u + v * v;
  const auto& p = camera.parameters;
  const std::string_view name = camera.model->name;
  if (name == "SIMPLE_PINHOLE") return {p[0] * u + p[1], p[0] * v + p[2]};
  if (name == "PINHOLE") return {p[0] * u + p[2], p[1] * v + p[3]};
  if (name == "SIMPLE_RADIAL") {
    const double radial = 1 + p[3] * r2;
    return {p[0] * u * radial + p[1], p[0] * v * radial + p[2]};
  }
  if (name == "RADIAL") {
    const double radial = 1 + p[3] * r2 + p[4] * r2 * r2;
    return {p[0] * u * radial + p[1], p[0] * v * radial + p[2]};
  }
  if (name == "OPENCV" || name == "FULL_OPENCV") {
    double radial = 1 + p[4] * r2 + p[5] * r2 * r2;
    if (name == "FULL_OPENCV")
      radial = (radial + p[8] * r2 * r2 * r2) / (1 + p[9] * r2 + p[10] * r2 * r2 + p[11] * r2 * r2 * r2);
    const double x = u * radial + 2 * p[6] * u * v + p[7] * (r2 + 2 * u * u);
    const double y = v * radial + 2 * p[7] * u * v + p[6] * (r2 + 2 * v * v);
    return {p[0] * x + p[2], p[1] * y + p[3]};
  }
  if (name == "FOV") {
    const double factor = std::atan(std::sqrt(r2) * 2 * std::tan(p[4] / 2)) / (std::sqrt(r2) * p[4]);
    return {p[0] * u * factor + p[2], p[1] * v * factor + p[3]};
  }
  if (name == "SIMPLE_DIVISION" || name == "DIVISION") {
    // Where the undistorted ray of a distorted one, x / (1 + k x^2), is this one.
    const std::size_t at = camera.model->focal_count;
    const double k = p[at + 2];
    const double r = std::sqrt(r2);
    double bent = r;
    for (int i = 0; i < 200; ++i) bent = r * (1 + k * bent * bent);
    return {p[0] * u / r * bent + p[at], p[at - 1] * v / r * bent + p[at + 1]};
  }
  if (name == "EUCM") {
    const double below = p[4] * std::sqrt(p[5] * r2 + 1) + 1 - p[4];
    return {p[0] * u / below + p[2], p[1] * v / below + p[3]};
  }
  const double theta = std::atan(std::sqrt(r2));
  const double s = r2 > 0 ? theta / std::sqrt(r2) : 1.0;
  if (name == "THIN_PRISM_FISHEYE") {
    const double x = u * s, y = v * s, q = x * x + y * y;
    const double radial = p[4] * q + p[5] * q * q + p[8] * std::pow(q, 3) + p[9] * std::pow(q, 4);
    return {p[0] * (x + x * radial + 2 * p[6] * x * y + p[7] * (q + 2 * x * x) + p[10] * q) + p[2],
            p[1] * (y + y * radial + 2 * p[7] * x * y + p[6] * (q + 2 * y * y) + p[11] * q) + p[3]};
  }
  if (name == "RAD_TAN_THIN_PRISM_FISHEYE") {
    double radial = 1;
    for (int i = 0; i < 6; ++i) radial += p[4 + static_cast<std::size_t>(i)] * std::pow(theta, 2 * i + 2);
    const double x = u * s * radial, y = v * s * radial, q = x * x + y * y;
    return {p[0] * (x + 2 * p[11] * x * y + p[10] * (q + 2 * x * x) + p[12] * q + p[13] * q * q) + p[2],
            p[1] * (y + 2 * p[10] * x * y + p[11] * (q + 2 * y * y) + p[14] * q + p[15] * q * q) + p[3]};
  }
  const std::size_t at = camera.model->focal_count;
  double bent = theta;
  for (std::size_t i = 0; i < camera.model->coefficient_count; ++i)
    bent += p[at + 2 + i] * std::pow(theta, 3.0 + 2.0 * static_cast<double>(i));
  const double scale = r2 > 0 ? bent / std::sqrt(r2) : 1.0;
  return {p[0] * u * scale + p[at], p[at - 1] * v * scale + p[at + 1]};
}

}  // namespace

ColmapModel make_colmap_model(const std::string& name) {
  ColmapModel model;
  const auto models = colmap_camera_models();
  const auto known = std::ranges::find(models, name, &ColmapCameraModel::name);
  if (known == models.end()) {
    ADD_FAILURE() << "no camera model " << name;
    return model;
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  for (std::uint64_t id = 1; id <= 60; ++id) {
    ColmapPoint point;
    point.id = 1000 + id;
    point.position = {spread(random), 0.6 * spread(random), spread(random)};
    point.color = {static_cast<std::uint8_t>(id), 20, 30};
    model.points.push_back(point);
  }
  for (std::uint32_t index = 0; index < 4; ++index) {
    ColmapCamera camera{index + 1, &*known, 64 + static_cast<int>(index), 48, {}};
    camera.parameters = parameters_of(*known, camera.width);
    ColmapImage image;
    image.id = 10 * (index + 1);
    image.camera_id = camera.id;
    image.name = std::string(1, static_cast<char>('a' + index)) + ".png";
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2 * index - 0.3, Eigen::Vector3d::UnitY()));
    image.rotation = {turn.w(), turn.x(), turn.y(), turn.z()};
    image.translation = {0.01 * index, -0.02, 4.0};
    for (ColmapPoint& point : model.points) {
      const Eigen::Vector2d pixel = project(camera, turn * point.position + image.translation);
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > camera.width || pixel.y() > camera.height) continue;
      image.observations.push_back({pixel, point.id});
      point.image_ids.push_back(image.id);
    }
    model.cameras.push_back(camera);
    model.images.push_back(image);
  }
  return model;
}

void write_colmap_text(const std::filesystem::path& folder, const ColmapModel& model) {
  std::filesystem::create_directories(folder);
  std::string cameras = "# Camera list\n";
  for (const ColmapCamera& camera : model.cameras) {
    cameras += fmt::format("{} {} {} {}", camera.id, camera.model->name, camera.width, camera.height);
    for (const double value : camera.parameters) cameras += fmt::format(" {:.17g}", value);
    cameras += "\n";
  }
  std::string images = "# Image list\n";
  std::map<std::uint64_t, std::string> tracks;
  for (const ColmapImage& image : model.images) {
    images += fmt::format("{}", image.id);
    for (const double value : image.rotation) images += fmt::format(" {:.17g}", value);
    for (int axis = 0; axis < 3; ++axis) images += fmt::format(" {:.17g}", image.translation(axis));
    images += fmt::format(" {} {}\n1.5 2.5 -1", image.camera_id, image.name);
    int place = 1;
    for (const ColmapObservation& seen : image.observations) {
      images += fmt::format(" {:.17g} {:.17g} {}", seen.pixel.x(), seen.pixel.y(), seen.point_id);
      tracks[seen.point_id] += fmt::format(" {} {}", image.id, place++);
    }
    images += "\n";
  }
  std::string points = "# 3D point list\n";
  for (const ColmapPoint& point : model.points)
    points +=
        fmt::format("{} {:.17g} {:.17g} {:.17g} {} {} {} 0.5{}\n", point.id, point.position.x(), point.position.y(),
                    point.position.z(), point.color[0], point.color[1], point.color[2], tracks[point.id]);
  write_text(folder / "cameras.txt", cameras);
  write_text(folder / "images.txt", images);
  write_text(folder / "points3D.txt", points);
}

void write_colmap_scene(const std::filesystem::path& folder, const ColmapModel& model) {
  std::filesystem::create_directories(folder / "images");
  std::filesystem::create_directories(folder / "sparse");
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const ColorImage photograph(model.cameras[i].width, model.cameras[i].height, make_rgb(50, 60, 70));
    EXPECT_TRUE(write_png(folder / "images" / model.images[i].name, photograph));
  }
  EXPECT_TRUE(write_colmap_model(folder / "sparse", model));
}

}  // namespace quorum
