#include "engine/io/colmap.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/io/colmap_test.h"
#include "tests/engine/io/io_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// How far the points of a model fall from their observations when the scene's cameras project them.
struct Reprojection {
  std::size_t count = 0;
  double mean_distance = 0.0;
  double largest = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  ///< shift from the observations to the projections
};

/// Observations are undistorted into the view's image, where both are compared.
Reprojection reproject(const ColmapModel& model, const Scene& scene) {
  Reprojection result;
  for (const ColmapImage& image : model.images) {
    const auto view = std::ranges::find(scene.views, image.name, &View::image_name);
    EXPECT_NE(view, scene.views.end());
    for (const ColmapObservation& seen : image.observations) {
      const auto point = std::ranges::find(model.points, seen.point_id, &ColmapPoint::id);
      Eigen::Vector2d expected = seen.pixel.array() - 0.5;
      if (view->lens) {
        const auto ray = view->lens->unproject(expected);
        EXPECT_TRUE(ray) << image.name;
        expected = (view->camera.intrinsics * Eigen::Vector3d(ray->x(), ray->y(), 1.0)).head<2>();
      }
      const Eigen::Vector2d shift = view->camera.project(point->position).head<2>() - expected;
      result.mean += shift;
      result.mean_distance += shift.norm();
      result.largest = std::max(result.largest, shift.norm());
      ++result.count;
    }
  }
  result.mean /= static_cast<double>(result.count);
  result.mean_distance /= static_cast<double>(result.count);
  return result;
}

using Colmap = ColmapTest;

TEST_F(Colmap, PointsFallOnTheirObservationsWithEveryCameraModel) {
  for (const ColmapCameraModel& kind : colmap_camera_models()) {
    const ColmapModel model = make_colmap_model(std::string(kind.name));
    write(model);
    const auto scene = read();
    ASSERT_TRUE(scene) << kind.name << ": " << scene.error().message;
    EXPECT_EQ(scene->views[0].lens.has_value(), !kind.name.ends_with("PINHOLE")) << kind.name;
    const Reprojection found = reproject(model, *scene);
    EXPECT_GT(found.count, 150U) << kind.name;
    EXPECT_LT(found.largest, 1e-6) << kind.name;
    RecordProperty(std::string(kind.name) + "_largest_px", fmt::format("{:.1e}", found.largest));
  }
}

TEST_F(Colmap, ViewsHaveTheirOwnSizesAndStandInTheOrderOfTheirNames) {
  ColmapModel model = make_colmap_model("PINHOLE");
  std::swap(model.images[0], model.images[3]);
  std::swap(model.cameras[0], model.cameras[3]);
  write(model);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    const View& view = scene->views[static_cast<std::size_t>(i)];
    EXPECT_EQ(view.name, std::string(1, static_cast<char>('a' + i)));
    EXPECT_EQ(view.image_name, view.name + ".png");
    EXPECT_EQ(view.width, 64 + i);
    EXPECT_EQ(view.height, 48);
    EXPECT_FALSE(view.lens);
  }
  EXPECT_EQ(scene->views[1].camera.intrinsics(0, 2), 65 / 2.0 + 1.5 - 0.5);
  ASSERT_EQ(scene->points.size(), 60U);
  for (const SparsePoint& point : scene->points) {
    EXPECT_TRUE(std::ranges::is_sorted(point.views));
    for (const int view : point.views) {
      const Eigen::Vector3d pixel = scene->views[static_cast<std::size_t>(view)].camera.project(point.position);
      EXPECT_GE(pixel.x(), -0.5);
      EXPECT_LE(pixel.x(), 66.5);
    }
  }
}

TEST_F(Colmap, AnImageThatComesTwiceInATrackCountsOnce) {
  ColmapModel model = make_colmap_model("PINHOLE");
  model.images[0].observations.push_back(model.images[0].observations[0]);
  write(model);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(std::ranges::count(scene->points[0].views, 0), 1);
}

TEST_F(Colmap, CamerasThatAreNoneAreRefused) {
  const ColmapModel good = make_colmap_model("OPENCV");
  ColmapModel model = good;
  model.cameras[0].parameters[0] = 0.0;
  write(model);
  expect_bad_input(read(), {"a.png", "focal length that is not positive"});
  model = good;
  model.cameras[0].parameters[4] = -1e9;
  write(model);
  expect_bad_input(read(), {"a.png", "can't be undistorted"});
  model = good;
  model.images[1].rotation = {0, 0, 0, 0};
  write(model);
  expect_bad_input(read(), {"b.png", "its pose is none"});
  model = good;
  model.images[1].translation.y() = std::nan("");
  write(model);
  expect_bad_input(read(), {"b.png", "not finite", "correct it, or leave the view out"});
}

TEST_F(Colmap, ValuesBeyondAllSenseAreRefusedWithTheImageAndTheRemedy) {
  const ColmapModel good = make_colmap_model("PINHOLE");
  const auto refuse = [&](auto change, std::string_view what) {
    ColmapModel model = good;
    change(model);
    write(model);
    expect_bad_input(read(), {"sparse", what, "correct it, or leave the view out"});
  };
  for (const double focal : {1e30, 1e-30})
    refuse([focal](ColmapModel& model) { model.cameras[0].parameters[0] = focal; }, "\"a.png\": its focal length");
  refuse([](ColmapModel& model) { model.cameras[0].parameters[2] = -1e7; }, "\"a.png\": its principal point");
  refuse([](ColmapModel& model) { model.images[1].translation.x() = 1e30; }, "\"b.png\": its position");
}

TEST_F(Colmap, ModelsWithFewViewsAreRefused) {
  ColmapModel model = make_colmap_model("PINHOLE");
  model.images.resize(1);
  for (ColmapPoint& point : model.points) point.image_ids.clear();
  write(model);
  expect_bad_input(read(), {"holds 1 views, expected 3 or more"});
  model.images.clear();
  write(model);
  expect_bad_input(read(), {"the model holds no image"});
}

TEST(ColmapData, SparsePointsOfRealModelsFallOnTheirObservations) {
  if (data_folder().empty()) GTEST_SKIP() << "no ../shared/data";
  struct Set {
    const char* folder;
    std::size_t views;
    std::size_t least_observations;
    double mean_distance;
  };
  for (const Set& set : {Set{"colmap_bartoszek", 23, 5000, 0.8}, Set{"colmap_lund_door", 12, 50000, 1.5}}) {
    const fs::path folder = data_folder() / set.folder;
    const ColmapModel model = read_colmap_model(find_colmap_model(folder)).value();
    const auto scene = read_colmap(folder, {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->views.size(), set.views);
    const Reprojection found = reproject(model, *scene);
    EXPECT_GT(found.count, set.least_observations) << set.folder;
    EXPECT_LT(found.mean_distance, set.mean_distance) << set.folder;
    EXPECT_LT(found.mean.norm(), 0.05) << set.folder << ": half a pixel would show here";
    RecordProperty(std::string(set.folder) + "_mean_px", fmt::format("{:.4f} of {}", found.mean_distance, found.count));
  }
}

}  // namespace
}  // namespace quorum
