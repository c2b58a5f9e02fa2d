// What the tests of readers of programs for structure from motion share: a file made by the rules of each format, with
// points that must lie where that program's own formula shows them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/opensfm.h"
#include "engine/io/realitycapture.h"
#include "engine/io/sfm_formats.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr int kViews = 4;
constexpr int kPoints = 30;

/// Where a program says that it shows the ray (x, y, 1), from the corner of the top-left pixel.
using Formula = std::function<Vector2d(double x, double y)>;

/// Four photographs a.png to d.png on an arc around some points, and which of these each shows.
class SfmFormatsTest : public testing::Test {
 protected:
  SfmFormatsTest() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> spread(-0.7, 0.7);
    for (int i = 0; i < kPoints; ++i) points_.emplace_back(spread(random), 0.7 * spread(random), spread(random));
    for (int i = 0; i < kViews; ++i) {
      const Eigen::Matrix3d turn =
          (Eigen::AngleAxisd(0.25 * i - 0.4, Vector3d::UnitY()) * Eigen::AngleAxisd(0.1 * i, Vector3d::UnitX()))
              .toRotationMatrix();
      rotations_.push_back(turn);
      centers_.push_back(turn.transpose() * Vector3d(0.02 * i, -0.01, -4.0));
      EXPECT_TRUE(write_png(path(name(i)), ColorImage(kWidth, kHeight, make_rgb(50, 60, 70))));
    }
  }

  [[nodiscard]] fs::path path(const std::string& file) const { return folder_.path() / file; }
  static std::string name(int view) { return std::string(1, static_cast<char>('a' + view)) + ".png"; }
  /// Points are seen by the views of their index's low bits, and by the first two.
  static bool sees(int view, int point) { return view < 2 || (point >> (view - 2) & 1) != 0; }
  static std::string list(const auto& values, const char* separator = ", ", const char* quote = "") {
    std::string text;
    for (const double value : values)
      text += fmt::format("{}{}{:.17g}{}", text.empty() ? "" : separator, quote, value, quote);
    return text;
  }
  void change(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_file(path(file)).value();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(path(file), text.replace(at, from.size(), to));
  }

  /// Reads the folder, and compares where the views show the points with a formula, in pixels.
  void expect_reprojection(SceneFormat format, const Formula& formula, bool with_points = true) {
    ASSERT_EQ(recognize_format(folder_.path()).value(), format);
    const auto scene = read_scene(folder_.path(), {});
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->views.size(), std::size_t{kViews});
    double residual = 0.0;
    for (int i = 0; i < kViews; ++i) {
      const View& view = scene->views[static_cast<std::size_t>(i)];
      EXPECT_EQ(view.image_path, path(name(i)));
      for (const Vector3d& point : points_) {
        const Vector3d in_camera =
            rotations_[static_cast<std::size_t>(i)] * (point - centers_[static_cast<std::size_t>(i)]);
        const Vector2d ray = in_camera.head<2>() / in_camera.z();
        const Vector3d ours = view.camera.to_camera(point - scene->offset);
        const Vector2d shown = view.lens ? view.lens->project(ours.head<2>() / ours.z())
                                         : Vector2d(view.camera.project(point - scene->offset).head<2>());
        residual = std::max(residual, (shown - (formula(ray.x(), ray.y()) - Vector2d(0.5, 0.5))).norm());
      }
    }
    EXPECT_LT(residual, 1e-7);
    largest_residual_ = std::max(largest_residual_, residual);
    RecordProperty("largest_px", fmt::format("{:.1e}", largest_residual_));
    if (!with_points) return;
    ASSERT_EQ(scene->points.size(), std::size_t{kPoints});
    for (const SparsePoint& point : scene->points) {
      const auto known = std::ranges::find_if(
          points_, [&](const Vector3d& p) { return (p - scene->offset - point.position).norm() < 1e-9; });
      ASSERT_NE(known, points_.end());
      std::vector<int> expected;
      for (int view = 0; view < kViews; ++view)
        if (sees(view, static_cast<int>(known - points_.begin()))) expected.push_back(view);
      EXPECT_EQ(point.views, expected);
    }
  }

  std::string openmvg_file(const std::string& model, const std::string& distortion) {
    std::string views, extrinsics, structure;
    for (int i = 0; i < kViews; ++i) {
      const Eigen::Matrix3d& r = rotations_[static_cast<std::size_t>(i)];
      views += fmt::format(
          R"({}{{"key": {}, "value": {{"polymorphic_id": 1073741824, "ptr_wrapper": {{"id": {}, "data": {{"local_path": "/", "filename": "{}", "width": 64, "height": 48, "id_view": {}, "id_intrinsic": {}, "id_pose": {}}}}}}}}})",
          i == 0 ? "" : ",\n", i, 2147483649 + i, name(i), 10 + i, i % 2, 20 + i);
      extrinsics += fmt::format(R"({}{{"key": {}, "value": {{"rotation": [[{}], [{}], [{}]], "center": [{}]}}}})",
                                i == 0 ? "" : ",\n", 20 + i, list(r.row(0)), list(r.row(1)), list(r.row(2)),
                                list(centers_[static_cast<std::size_t>(i)]));
    }
    for (int p = 0; p < kPoints; ++p) {
      std::string seen;
      for (int i = 0; i < kViews; ++i)
        if (sees(i, p))
          seen += fmt::format(R"({}{{"key": {}, "value": {{"id_feat": 1, "x": [1.0, 2.0]}}}})",
                              seen.empty() ? "" : ", ", 10 + i);
      structure += fmt::format(R"({}{{"key": {}, "value": {{"X": [{}], "observations": [{}]}}}})", p == 0 ? "" : ",\n",
                               p, list(points_[static_cast<std::size_t>(p)]), seen);
    }
    // The second intrinsic names its class by the number of the first.
    std::string intrinsics;
    for (int i = 0; i < 2; ++i)
      intrinsics += fmt::format(
          R"({}{{"key": {}, "value": {{"polymorphic_id": {}, {}"ptr_wrapper": {{"id": {}, "data": {{"width": 64, "height": 48, "focal_length": 70.0, "principal_point": [33.0, 22.5]{}}}}}}}}})",
          i == 0 ? "" : ",\n", i, i == 0 ? 2147483649 : 1,
          i == 0 ? fmt::format("\"polymorphic_name\": \"{}\", ", model) : "", 2147483700 + i, distortion);
    return fmt::format(
        "{{\"sfm_data_version\": \"0.3\", \"root_path\": \"/of/another/machine\", \"views\": [{}], \"intrinsics\": "
        "[{}], "
        "\"extrinsics\": [{}], \"structure\": [{}], \"control_points\": []}}",
        views, intrinsics, extrinsics, structure);
  }

  void write_opensfm(const std::string& camera) {
    std::string shots, points;
    std::string tracks = "OPENSFM_TRACKS_VERSION_v2\n";
    for (int i = 0; i < kViews; ++i) {
      const Eigen::Matrix3d& r = rotations_[static_cast<std::size_t>(i)];
      const Eigen::AngleAxisd turn(r);
      shots += fmt::format(R"({}"{}": {{"rotation": [{}], "translation": [{}], "camera": "v2 x", "orientation": 1}})",
                           i == 0 ? "" : ",\n", name(i), list(Vector3d(turn.angle() * turn.axis())),
                           list(Vector3d(-r * centers_[static_cast<std::size_t>(i)])));
    }
    for (int p = 0; p < kPoints; ++p) {
      points += fmt::format(R"({}"{}": {{"coordinates": [{}], "color": [1, 2, 3]}})", p == 0 ? "" : ",\n", 100 + p,
                            list(points_[static_cast<std::size_t>(p)]));
      for (int i = 0; i < kViews; ++i)
        if (sees(i, p)) tracks += fmt::format("{}\t{}\t7\t0.1\t0.2\t0.003\t1\t2\t3\t-1\t-1\n", name(i), 100 + p);
    }
    fs::create_directories(path("opensfm"));
    write_text(path("opensfm/reconstruction.json"), fmt::format(R"([{{"cameras": {{}}, "shots": {{}}, "points": {{}}}},
                   {{"cameras": {{"v2 x": {{"width": 64, "height": 48, {}}}}}, "shots": {{{}}}, "points": {{{}}}}}])",
                                                                camera, shots, points));
    write_text(path("opensfm/tracks.csv"), tracks + "unknown.png\t100\t7\t0.1\t0.2\n");
  }

  void write_meshroom(const std::string& version, const std::string& intrinsic) {
    std::string views, poses, structure;
    for (int i = 0; i < kViews; ++i) {
      // Eigen's order: column by column.
      const Eigen::Matrix3d& r = rotations_[static_cast<std::size_t>(i)];
      const std::vector<double> columns(r.data(), r.data() + 9);
      views += fmt::format(
          R"({}{{"viewId": "{}", "poseId": "{}", "intrinsicId": "5", "path": "C:\\photos\\{}", "width": "64", "height": "48", "metadata": ""}})",
          i == 0 ? "" : ",\n", 10 + i, 20 + i, name(i));
      poses += fmt::format(
          R"({}{{"poseId": "{}", "pose": {{"transform": {{"rotation": [{}], "center": [{}]}}, "locked": "0"}}}})",
          i == 0 ? "" : ",\n", 20 + i, list(columns, ", ", "\""),
          list(centers_[static_cast<std::size_t>(i)], ", ", "\""));
    }
    for (int p = 0; p < kPoints; ++p) {
      std::string seen;
      for (int i = 0; i < kViews; ++i)
        if (sees(i, p)) seen += fmt::format(R"({}{{"observationId": "{}"}})", seen.empty() ? "" : ", ", 10 + i);
      structure += fmt::format(R"({}{{"landmarkId": "{}", "X": [{}], "observations": [{}]}})", p == 0 ? "" : ",\n", p,
                               list(points_[static_cast<std::size_t>(p)], ", ", "\""), seen);
    }
    write_text(path("cameras.sfm"),
               fmt::format(R"({{"version": [{}], "views": [{}, {{"viewId": "99", "path": "lost.png"}}],
                 "intrinsics": [{{"intrinsicId": "5", "width": "64", "height": "48", {}}}], "poses": [{}], "structure": [{}]}})",
                           version, views, intrinsic, poses, structure));
  }

  void write_metashape(const std::string& type, const std::string& calibration) {
    // World from chunk: scale 2, a turn and a shift.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Vector3d shift(1, -2, 0.5);
    std::string cameras;
    for (int i = 0; i < kViews; ++i) {
      const Eigen::Matrix3d r = turn.transpose() * rotations_[static_cast<std::size_t>(i)].transpose();
      const Vector3d c = turn.transpose() * (centers_[static_cast<std::size_t>(i)] - shift) / 2.0;
      std::string numbers;
      for (int row = 0; row < 3; ++row)
        numbers += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} ", r(row, 0), r(row, 1), r(row, 2), c(row));
      cameras +=
          fmt::format("<camera id=\"{}\" sensor_id=\"3\" label=\"{}\"><transform>{}0 0 0 1</transform></camera>\n", i,
                      i % 2 == 0 ? name(i) : name(i).substr(0, 1), numbers);
    }
    const Eigen::Matrix3d rows = turn.transpose();
    const std::vector<double> turn_numbers(rows.data(), rows.data() + 9);
    write_text(path("cameras.xml"), fmt::format(
                                        R"(<?xml version="1.0" encoding="UTF-8"?>
<document version="2.0.0">
 <chunk label="Chunk 1" enabled="true">
  <sensors next_id="4">
   <sensor id="3" label="x" type="frame"><resolution width="64" height="48"/>
    <calibration type="frame" class="initial"><f>1</f></calibration>
    <calibration type="{}" class="adjusted"><resolution width="64" height="48"/>{}</calibration></sensor>
  </sensors>
  <cameras next_id="5">{}<camera id="8" sensor_id="3" label="lost"/></cameras>
  <transform><rotation locked="true">{}</rotation><translation>{}</translation><scale>2</scale></transform>
 </chunk>
 <chunk label="empty"/>
</document>
)",
                                        type, calibration, cameras, list(turn_numbers, " "), list(shift, " ")));
  }

  std::string nvm_file(double distortion) {
    std::string cameras, points;
    for (int i = 0; i < kViews; ++i)
      cameras += fmt::format("photos/{}\t70 {} {} {:.17g} 0\n", name(i),
                             list(quaternion_of_rotation(rotations_[static_cast<std::size_t>(i)]), " "),
                             list(centers_[static_cast<std::size_t>(i)], " "), distortion);
    for (int p = 0; p < kPoints; ++p) {
      int count = 0;
      std::string seen;
      for (int i = 0; i < kViews; ++i)
        if (sees(i, p)) {
          seen += fmt::format(" {} 4 0.5 0.5", i);
          ++count;
        }
      points += fmt::format("{} 1 2 3 {}{}\n", list(points_[static_cast<std::size_t>(p)], " "), count, seen);
    }
    return fmt::format("{}\n{}\n{}\n{}", kViews, cameras, kPoints, points);
  }

  TemporaryFolder folder_;
  std::vector<Vector3d> points_;
  std::vector<Eigen::Matrix3d> rotations_;  ///< world to camera
  std::vector<Vector3d> centers_;
  double largest_residual_ = 0.0;  ///< pixels, of all that the test has read
};

using SfmFormats = SfmFormatsTest;

/// Brown's model from its terms.
inline Formula brown(double focal, const Vector2d& center, std::vector<double> k, double p1, double p2) {
  return [=](double x, double y) {
    const double r2 = x * x + y * y;
    double radial = 1.0;
    for (std::size_t i = 0; i < k.size(); ++i) radial += k[i] * std::pow(r2, static_cast<double>(i + 1));
    return Vector2d(center.x() + focal * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)),
                    center.y() + focal * (y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)));
  };
}

/// The angle to the axis, bent by a polynomial.
inline Formula fisheye(double focal, const Vector2d& center, std::vector<double> k) {
  return [=](double x, double y) {
    const double r = std::hypot(x, y);
    const double angle = std::atan(r);
    double bent = angle;
    for (std::size_t i = 0; i < k.size(); ++i) bent += k[i] * std::pow(angle, 2.0 * static_cast<double>(i) + 3.0);
    return Vector2d(center + focal * bent / r * Vector2d(x, y));
  };
}

}  // namespace quorum
