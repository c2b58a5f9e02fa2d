#include "engine/io/colmap.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/io/colmap_files.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/colmap_scene.h"
#include "tests/support/test_support.h"

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

class ColmapTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  Expected<Scene> read() { return read_colmap(folder_.path(), {}); }
  /// Writes the scene, with a change to a file of the model.
  void write(const ColmapModel& model) { write_colmap_scene(folder_.path(), model); }
  void change(const std::string& file, const std::function<void(std::string&)>& change) {
    std::string bytes = read_file(path(file)).value();
    change(bytes);
    write_text(path(file), bytes);
  }

  TemporaryFolder folder_;
};

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

TEST_F(Colmap, TextAndBinaryAreTheSame) {
  for (const char* kind : {"PINHOLE", "FULL_OPENCV"}) {
    const ColmapModel model = make_colmap_model(kind);
    write(model);
    const Scene binary = read().value();
    for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"}) fs::remove(path("sparse") / file);
    write_colmap_text(path("sparse"), model);
    const auto text = read();
    ASSERT_TRUE(text) << text.error().message;
    ASSERT_EQ(text->views.size(), binary.views.size());
    for (std::size_t i = 0; i < binary.views.size(); ++i) {
      EXPECT_EQ(text->views[i].camera.intrinsics, binary.views[i].camera.intrinsics);
      EXPECT_EQ(text->views[i].camera.camera_from_world, binary.views[i].camera.camera_from_world);
      EXPECT_EQ(text->views[i].camera.translation, binary.views[i].camera.translation);
      EXPECT_EQ(text->views[i].width, binary.views[i].width);
    }
    ASSERT_EQ(text->points.size(), binary.points.size());
    for (std::size_t i = 0; i < binary.points.size(); ++i) {
      EXPECT_EQ(text->points[i].position, binary.points[i].position);
      EXPECT_EQ(text->points[i].views, binary.points[i].views);
    }
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

TEST_F(Colmap, ModelIsFoundWhereItUsuallyStands) {
  write(make_colmap_model("PINHOLE"));
  EXPECT_EQ(find_colmap_model(folder_.path()), path("sparse"));
  fs::rename(path("sparse"), path("0"));
  EXPECT_EQ(find_colmap_model(folder_.path()), path("0"));
  fs::create_directories(path("sparse"));
  fs::copy(path("0"), path("sparse/0"));
  EXPECT_EQ(find_colmap_model(folder_.path()), path("sparse/0"));
  EXPECT_TRUE(read());
  EXPECT_TRUE(read_colmap(path("sparse/0"), {})) << "images two folders above the model";
}

TEST_F(Colmap, LargestOfSeveralModelsIsTakenAndSaid) {
  const ColmapModel all = make_colmap_model("PINHOLE");
  ColmapModel few = all;
  few.images.resize(3);
  write(all);
  fs::create_directories(path("sparse/0"));
  fs::create_directories(path("sparse/1"));
  for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"})
    fs::rename(path("sparse") / file, path("sparse/1") / file);
  write_colmap_text(path("sparse/0"), few);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views.size(), 4U);
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_EQ(scene->notes[0],
            "sparse/1 is taken, the largest of 2 models, with 4 images (sparse/0 3); option model chooses another");
  for (const char* chosen : {"sparse/0", "0"}) {
    const auto other = read_colmap(folder_.path(), {}, chosen);
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(other->views.size(), 3U);
    EXPECT_TRUE(std::ranges::none_of(other->notes, [](const std::string& n) { return n.contains("option model"); }));
  }
  expect_bad_input(read_colmap(folder_.path(), {}, "2"), {"holds no COLMAP model", "option model"});
}

TEST_F(Colmap, RigsAndFramesOfNewerModelsChangeNothing) {
  write(make_colmap_model("PINHOLE"));
  write_text(path("sparse/rigs.bin"), "rigs");
  write_text(path("sparse/frames.bin"), "frames");
  EXPECT_TRUE(read());
}

TEST_F(Colmap, ModelWithoutPointsIsTaken) {
  write(make_colmap_model("PINHOLE"));
  fs::remove(path("sparse/points3D.bin"));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->points.empty());
}

TEST_F(Colmap, ImagesInFoldersAreNamedApart) {
  ColmapModel model = make_colmap_model("PINHOLE");
  model.images[0].name = "left/1.png";
  model.images[1].name = "right/1.png";
  model.images[2].name = "right/2.png";
  model.images[3].name = "right/2.jpg";
  fs::create_directories(path("images/left"));
  fs::create_directories(path("images/right"));
  write(model);
  write_png(path("images/right/2.jpg"), ColorImage(67, 48)).value();
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  std::vector<std::string> names;
  for (const View& view : scene->views) names.push_back(view.name);
  EXPECT_EQ(names, (std::vector<std::string>{"left_1", "right_1", "right_2.jpg", "right_2.png"}));
}

TEST_F(Colmap, CutOffFilesAreRefusedWithoutLargeAllocations) {
  const ColmapModel model = make_colmap_model("OPENCV");
  write(model);
  for (const std::string file : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string bytes = read_file(path("sparse/" + file)).value();
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{7}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
      write_text(path("sparse/" + file), bytes.substr(0, size));
      expect_bad_input(read(), {file, "copy"});
    }
    write_text(path("sparse/" + file), bytes + "x");
    expect_bad_input(read(), {file, "1 bytes follow"});
    std::string counts = bytes;
    counts[6] = '\x7f';  // 2^54 records and more
    write_text(path("sparse/" + file), counts);
    expect_bad_input(read(), {file, "is shorter"});
    write_text(path("sparse/" + file), bytes);
  }
  // The count of an image's features, and of a point's track.
  change("sparse/images.bin", [](std::string& bytes) { bytes[8 + 4 + 56 + 4 + 6 + 5] = '\x7f'; });
  expect_bad_input(read(), {"images.bin", "image 1", "cut off"});
}

TEST_F(Colmap, NamesOfSeveralLinesAreRefusedOnOne) {
  write(make_colmap_model("PINHOLE"));
  change("sparse/images.bin", [](std::string& bytes) { bytes[bytes.find("b.png")] = '\n'; });
  expect_bad_input(read(), {"images.bin", "image 2", "control characters"});
}

TEST_F(Colmap, UnknownCameraModelIsNamed) {
  write(make_colmap_model("PINHOLE"));
  change("sparse/cameras.bin", [](std::string& bytes) { bytes[12] = 77; });
  expect_bad_input(read(), {"cameras.bin", "camera 1", "model 77"});
  expect_bad_input(parse_colmap_cameras_txt("cameras.txt", "# c\n1 FISHY 10 10 1 2 3\n"),
                   {"cameras.txt:2", "\"FISHY\"", "DIVISION"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 EQUIRECTANGULAR 10 10 10 10\n"), {"c:1", "panorama"});
  write(make_colmap_model("PINHOLE"));
  change("sparse/cameras.bin", [](std::string& bytes) { bytes[12] = 17; });
  expect_bad_input(read(), {"cameras.bin", "EQUIRECTANGULAR", "cut the panoramas"});
}

TEST_F(Colmap, WrongLinesOfTextAreNamed) {
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE 10 10 1 2 3\n"), {"c:1", "a parameter is missing"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE 10 10 1 2 3 4 5\n"), {"c:1", "1 fields are left over"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE wide 10 1 2 3 4\n"), {"c:1", "WIDTH = \"wide\""});
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a.png\n1 2\n"), {"i:2", "POINT3D_ID is missing"});
  EXPECT_EQ(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a.png")->size(), 1U) << "COLMAP reads it, too";
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1\n\n"), {"i:1", "NAME is missing"});
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a\x1b[31m.png\n\n"), {"i:1", "control characters"});
  EXPECT_EQ(parse_colmap_cameras_txt("c",
                                     "\xef\xbb\xbf"
                                     "1 PINHOLE 10 10 1 2 3 4")
                ->size(),
            1U)
      << "a byte order mark";
  expect_bad_input(parse_colmap_points_txt("p", "1 0 0 0 1 2 300 0\n"), {"p:1", "a color = \"300\""});
  expect_bad_input(parse_colmap_points_txt("p", "1 0 0 0 1 2 3 0 7\n"), {"p:1", "POINT2D_IDX is missing"});
  EXPECT_EQ(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 my photo.png\n\n2 1 0 0 0 0 0 0 1 b\n\n")->at(0).name,
            "my photo.png");
}

TEST_F(Colmap, ReferencesToWhatIsAbsentAreNamed) {
  const ColmapModel good = make_colmap_model("PINHOLE");
  ColmapModel model = good;
  model.images[2].camera_id = 99;
  write(model);
  expect_bad_input(read(), {"images.bin", "image 30 refers to camera 99"});
  model = good;
  model.images[3].id = 99;
  write(model);
  change("sparse/images.bin", [&](std::string& bytes) {
    const std::size_t name = bytes.find("d.png");
    bytes[name - 4 - 56 - 4] = 98;
  });
  // Its sightings name an image that was removed.
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_TRUE(scene->notes[0].starts_with(std::to_string(good.images[3].observations.size()) + " sightings"))
      << scene->notes[0];
  model = good;
  model.cameras[1].id = 1;
  write(model);
  expect_bad_input(read(), {"cameras.bin", "camera 1 twice"});
  model = good;
  model.images[1].id = 10;
  write(model);
  expect_bad_input(read(), {"images.bin", "image 10 twice"});
  model = good;
  model.points[1].id = model.points[0].id;
  write(model);
  expect_bad_input(read(), {"points3D.bin", "point 1001 twice"});
}

TEST_F(Colmap, PhotographsMustBeThereAndHaveTheirCamerasSize) {
  write(make_colmap_model("SIMPLE_RADIAL"));
  write_png(path("images/b.png"), ColorImage(64, 48)).value();
  expect_bad_input(read(), {"image \"b.png\"", "is 64 x 48, its camera 65 x 48"});
  write_png(path("images/b.png"), ColorImage(48, 65)).value();
  expect_bad_input(read(), {"image \"b.png\"", "is 48 x 65, its camera 65 x 48"});
  fs::remove_all(path("images"));
  expect_bad_input(read(), {"image \"a.png\" of the model is not there", "option images"});
}

TEST_F(Colmap, AbsentPhotographsAreLeftOutAndCounted) {
  write(make_colmap_model("SIMPLE_RADIAL"));
  const Scene whole = read().value();
  fs::remove(path("images/a.png"));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 3U);
  EXPECT_EQ(scene->views[0].name, "b");
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_EQ(scene->notes[0], "1 of 4 photographs is not there and left out: a.png");
  for (const SparsePoint& point : scene->points) {
    EXPECT_FALSE(point.views.empty());
    for (const int view : point.views) {
      const auto other = std::ranges::find(whole.points, point.position, &SparsePoint::position);
      EXPECT_TRUE(std::ranges::binary_search(other->views, view + 1));
    }
  }
  fs::remove(path("images/c.png"));
  expect_bad_input(read(), {"2 of 4 photographs are there", "a.png", "option images"});
}

TEST_F(Colmap, PhotographsOfAnotherSizeScaleTheirCameras) {
  const ColmapModel model = make_colmap_model("OPENCV");
  write(model);
  const Scene whole = read().value();
  fs::create_directories(path("images_2"));
  for (std::size_t i = 0; i < 4; ++i)
    write_png(path("images_2") / model.images[i].name, ColorImage(2 * model.cameras[i].width, 96)).value();
  const auto scene = read_colmap(folder_.path(), path("images_2"));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_FALSE(scene->notes.empty());
  EXPECT_TRUE(scene->notes.back().ends_with("scaled by 2")) << scene->notes.back();
  const Lens& small = *whole.views[1].lens;
  const Lens& large = *scene->views[1].lens;
  for (const Eigen::Vector2d& ray : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.3, -0.2)}) {
    const Eigen::Vector2d expected = (2 * (small.project(ray).array() + 0.5) - 0.5).matrix();
    EXPECT_LT((large.project(ray) - expected).norm(), 1e-9);
  }
  EXPECT_EQ(scene->views[1].photo_width, 130);
  fs::remove_all(path("images"));
  EXPECT_EQ(read().value().notes.size(), 2U) << "found without being named, and said";
  write_png(path("images_2/b.png"), ColorImage(96, 130)).value();
  expect_bad_input(read(), {"b.png", "is 96 x 130, its camera 65 x 48"});
}

TEST_F(Colmap, NamesFromOtherMachinesAreFound) {
  ColmapModel model = make_colmap_model("PINHOLE");
  write(model);
  model.images[0].name = "/elsewhere/images/a.png";
  model.images[1].name = "D:\\photos\\images\\b.PNG";
  model.images[2].name = "c";
  ASSERT_TRUE(write_colmap_model(path("sparse"), model));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 4U) << scene->notes.at(0);
  std::vector<std::string> names;
  for (const View& view : scene->views) names.push_back(view.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
  model.images[2].name = "\\elsewhere\\a.png";
  ASSERT_TRUE(write_colmap_model(path("sparse"), model));
  expect_bad_input(read(), {"images/a.png", "photograph of another image, too"});
}

TEST_F(Colmap, ImagesMayStandElsewhere) {
  write(make_colmap_model("PINHOLE"));
  fs::rename(path("images"), path("photos"));
  EXPECT_FALSE(read());
  const auto scene = read_colmap(folder_.path(), path("photos"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views[2].image_path, path("photos/c.png"));
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
