#include "engine/io/scene_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/colmap_scene.h"
#include "tests/support/scene_formats.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// A COLMAP scene, and the same cameras in the other formats, each in a folder of its own.
class SceneFolderTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  Expected<Scene> read(const std::string& folder) { return read_scene(path(folder), SceneOptions{}); }

  void change(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_file(path(file)).value();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(path(file), text.replace(at, from.size(), to));
  }

  TemporaryFolder folder_;
  ColmapModel model_ = make_colmap_model("PINHOLE");
  Scene scene_ = write_scene_formats(folder_.path(), model_);
};

using SceneFolder = SceneFolderTest;

TEST_F(SceneFolder, FormatIsRecognized) {
  EXPECT_EQ(recognize_format(path("colmap")).value(), SceneFormat::kColmap);
  EXPECT_EQ(recognize_format(path("mvsnet")).value(), SceneFormat::kMvsnet);
  EXPECT_EQ(recognize_format(path("transforms")).value(), SceneFormat::kTransforms);
  EXPECT_EQ(recognize_format(path("bundler")).value(), SceneFormat::kBundler);
  write_text(path("bundler/x_par.txt"), "");
  EXPECT_EQ(recognize_format(path("bundler")).value(), SceneFormat::kMiddlebury);
  expect_bad_input(recognize_format(path("colmap/images")), {"no cameras in this folder", "_par.txt", "COLMAP"});
  expect_bad_input(recognize_format(path("none")), {"no such folder"});
  expect_bad_input(recognize_format(path("transforms/transforms.json")), {"is a file"});
  SceneOptions options;
  options.format = SceneFormat::kColmap;
  expect_bad_input(read_scene(path("mvsnet"), options), {"no COLMAP model"});
}

TEST_F(SceneFolder, AModelToChooseIsRefusedWhereThereIsNone) {
  SceneOptions options;
  options.model = "sparse/1";
  const auto scene = read_scene(path("mvsnet"), options);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::kUsage);
}

TEST_F(SceneFolder, BlendersPartsAreToldApart) {
  fs::rename(path("transforms/transforms.json"), path("transforms/transforms_train.json"));
  expect_bad_input(recognize_format(path("transforms")), {"transforms_train.json", "copy it to transforms.json"});
}

TEST_F(SceneFolder, ALastRowThatIsNotThatOfAPoseIsRefused) {
  change("mvsnet/cams/00000001_cam.txt", "0 0 0 1\n", "0 0 0 5\n");
  expect_bad_input(read("mvsnet"), {"00000001_cam.txt", "last row of the extrinsic matrix"});
}

TEST_F(SceneFolder, AllFormatsGiveTheSameCameras) {
  for (const char* folder : {"mvsnet", "transforms"}) {
    const auto other = read(folder);
    ASSERT_TRUE(other) << other.error().message;
    ASSERT_EQ(other->views.size(), scene_.views.size()) << folder;
    for (std::size_t i = 0; i < scene_.views.size(); ++i) {
      const Camera& expected = scene_.views[i].camera;
      const Camera& found = other->views[i].camera;
      EXPECT_EQ(found.intrinsics, expected.intrinsics) << folder;
      EXPECT_EQ(found.camera_from_world, expected.camera_from_world) << folder;
      // transforms.json holds the center instead: -R^T t and back rounds.
      EXPECT_LT((found.translation - expected.translation).norm(), 1e-14) << folder;
      EXPECT_EQ(other->views[i].width, scene_.views[i].width);
      EXPECT_EQ(other->views[i].height, scene_.views[i].height);
    }
  }
}

TEST_F(SceneFolder, BundlerCamerasLookAlongTheirNegativeAxis) {
  const auto other = read("bundler");
  ASSERT_TRUE(other) << other.error().message;
  ASSERT_EQ(other->views.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const View& view = other->views[i];
    EXPECT_EQ(view.image_name, "images/" + scene_.views[i].image_name);
    EXPECT_LT((view.camera.camera_from_world - scene_.views[i].camera.camera_from_world).norm(), 1e-15);
    EXPECT_EQ(view.camera.translation, scene_.views[i].camera.translation);
    ASSERT_TRUE(view.lens);
    EXPECT_EQ(view.lens->principal, Eigen::Vector2d((63 + static_cast<int>(i)) / 2.0, 23.5));
    EXPECT_EQ(view.lens->coefficients[1], 0.02);
  }
  // Cameras 1, 4 and 2 of the file, of which the first is lost, are views 0, 3 and 1.
  ASSERT_EQ(other->points.size(), 3U);
  EXPECT_EQ(other->points[0].views, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(other->points[1].views, (std::vector<int>{2}));
}

TEST_F(SceneFolder, CamerasOfPicturesOfAnotherSizeAreRefusedWhereNoFileTellsIt) {
  const View& view = scene_.views[1];
  for (const int factor : {2, 4}) {
    const ColorImage larger(factor * view.width, factor * view.height, make_rgb(1, 2, 3));
    ASSERT_TRUE(write_png(path("mvsnet/images/00000001.png"), larger));
    expect_bad_input(read("mvsnet"), {"00000001.png", "its principal point is the middle of a picture of about",
                                      "give photographs of that size"});
  }
}

TEST_F(SceneFolder, AMissingEndOfAJpegIsNoted) {
  fs::remove(path("bundler/images/a.png"));
  change("bundler/list.txt", "a.png", "a.jpg");
  const View& view = scene_.views[0];
  const std::string whole = encode_jpeg(ColorImage(view.width, view.height, make_rgb(1, 2, 3)), 90).value();
  write_text(path("bundler/images/a.jpg"), whole.substr(0, whole.size() - 2));
  const auto scene = read("bundler");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(std::ranges::count_if(scene->notes,
                                  [](const std::string& note) {
                                    return note.starts_with("1 photographs lack the marker of a JPEG file's end") &&
                                           note.ends_with("a.jpg");
                                  }),
            1);
  write_text(path("bundler/images/a.jpg"), whole.substr(0, whole.size() - 30));
  expect_bad_input(read("bundler"), {"a.jpg", "ends too early"});
}

TEST_F(SceneFolder, PairsAndDepthsOfMvsnetAreHonored) {
  const Scene scene = read("mvsnet").value();
  EXPECT_EQ(scene.views[0].neighbors, (std::vector<int>{2, 1, 3}));
  EXPECT_EQ(scene.views[1].neighbors, (std::vector<int>{0, 2}));
  EXPECT_TRUE(scene.views[3].neighbors.empty());
  EXPECT_EQ(scene.views[2].near_depth, 2.5);
  EXPECT_NEAR(scene.views[2].far_depth, 2.5 + 191 * 0.05, 1e-12);
  change("mvsnet/cams/00000002_cam.txt", "2.5 0.05", "2.5 0.05 100 7.25");
  EXPECT_EQ(read("mvsnet")->views[2].far_depth, 7.25);
}

TEST_F(SceneFolder, PatchMatchCfgIsHonored) {
  const std::string file = "colmap/stereo/patch-match.cfg";
  fs::create_directories(path("colmap/stereo"));
  write_text(path(file), "# pairs\na.png\nc.png, b.png,d.png\n\nb.png\n__auto__, 20\nc.png\n__all__\n");
  const Scene scene = read("colmap").value();
  EXPECT_EQ(scene.views[0].neighbors, (std::vector<int>{2, 1, 3}));
  EXPECT_TRUE(scene.views[1].neighbors.empty());
  EXPECT_EQ(scene.views[2].neighbors, (std::vector<int>{0, 1, 3}));
  write_text(path(file), "a.png\nb.png, x.png\n");
  const Scene partial = read("colmap").value();
  EXPECT_EQ(partial.views[0].neighbors, (std::vector<int>{1}));
  EXPECT_EQ(partial.notes,
            (std::vector<std::string>{"patch-match.cfg: 1 names of images that are not in the scene are left out"}));
  write_text(path(file), "y.png\nb.png\nc.png\na.png\nd.png\n");
  EXPECT_EQ(read("colmap")->views[2].neighbors, (std::vector<int>{0})) << "the last one has no sources, as in COLMAP";
}

TEST_F(SceneFolder, BoundsMayBeGivenAsABoxOrAFile) {
  SceneOptions options;
  options.roi = path("box.txt");
  write_text(options.roi, "# a box\n-1 -2 -3\n1 2 3 # end\n");
  EXPECT_EQ(read_scene(path("colmap"), options)->bounds.low, Eigen::Vector3d(-1, -2, -3));
  options.bounds = Bounds{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(read_scene(path("colmap"), options).error().kind, ErrorKind::kUsage);
  options.roi.clear();
  EXPECT_EQ(read_scene(path("colmap"), options)->bounds.high, Eigen::Vector3d(1, 1, 1));
  options.bounds.reset();
  options.roi = path("box.ply");
  Mesh mesh;
  mesh.vertices.resize(3);
  mesh.vertices[0].position = {1, 0, -2};
  mesh.vertices[1].position = {-1, 4, 0.5};
  ASSERT_TRUE(write_ply(options.roi, mesh));
  EXPECT_EQ(read_roi(options.roi)->low, Eigen::Vector3d(-1, 0, -2));
  EXPECT_EQ(read_roi(options.roi)->high, Eigen::Vector3d(1, 4, 0.5));
  write_text(path("box.txt"), "1 2 3\n4 five 6\n");
  expect_bad_input(read_roi(path("box.txt")), {"box.txt:2", "\"five\""});
  write_text(path("box.txt"), "1 2 3\n");
  expect_bad_input(read_roi(path("box.txt")), {"six numbers", "found 3"});
}

TEST_F(SceneFolder, AGivenBoxIsLookedAtAsAWhole) {
  EXPECT_GT(read("colmap")->views[0].far_depth, 0.0);
  SceneOptions options;
  options.bounds = Bounds{{-1, -1, -1}, {1, 1, 1}};
  EXPECT_EQ(read_scene(path("colmap"), options)->views[0].far_depth, 0.0);
  options.bounds = Bounds{{-10, -10, -10}, {10, 10, 10}};
  EXPECT_GT(read_scene(path("colmap"), options)->views[0].far_depth, 0.0) << "it holds the camera";
}

TEST_F(SceneFolder, MasksAreFoundInEveryFormat) {
  SceneOptions options;
  options.masks = path("masks");
  fs::create_directories(path("masks/images"));
  for (int i = 0; i < 4; ++i) {
    const std::string letter(1, static_cast<char>('a' + i));
    for (const std::string& name : {letter, "images/" + letter, fmt::format("{:08}", i)})
      write_png(path("masks") / (name + ".png.png"), ColorImage(64 + i, 48)).value();
  }
  for (const char* folder : {"colmap", "mvsnet", "transforms", "bundler"}) {
    const auto scene = read_scene(path(folder), options);
    ASSERT_TRUE(scene) << scene.error().message;
    for (const View& view : scene->views)
      EXPECT_EQ(view.mask_path, path("masks") / (view.image_name + ".png")) << folder;
  }
  fs::remove(path("masks/c.png.png"));
  expect_bad_input(read_scene(path("colmap"), options), {"no mask c.png.png or c.png for view c"});
}

TEST_F(SceneFolder, LargePhotographsAreHalved) {
  SceneOptions options;
  options.max_image_size = 40;
  const Scene scene = read_scene(path("colmap"), options).value();
  const View& view = scene.views[1];
  EXPECT_EQ(view.width, 32);  // of 65
  EXPECT_EQ(view.height, 24);
  for (const SparsePoint& point : scene.points) {
    // Pixel (x, y) of the half image is the mean of pixels 2 x and 2 x + 1.
    const Eigen::Vector3d whole = scene_.views[1].camera.project(point.position);
    const Eigen::Vector3d half = view.camera.project(point.position);
    EXPECT_NEAR(half.x(), (whole.x() - 0.5) / 2, 1e-9);
    EXPECT_NEAR(half.y(), (whole.y() - 0.5) / 2, 1e-9);
  }
  options.max_image_size = 5;
  EXPECT_EQ(read_scene(path("colmap"), options).error().kind, ErrorKind::kUsage);
}

TEST_F(SceneFolder, NotesArePrintableWhateverNamesSay) {
  model_.images[3].name = "T\xfcr.png";
  ASSERT_TRUE(write_colmap_model(path("colmap/sparse"), model_));
  const auto scene = read("colmap");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->notes.at(0), "1 of 4 photographs is not there and left out: T?r.png");
}

TEST_F(SceneFolder, LinesOfBundlersListArePaths) {
  fs::rename(path("bundler/images"), path("bundler/my photos 0"));
  write_text(
      path("bundler/list.txt"),
      "images/lost.png\nmy photos 0/a.png 0 70\nmy photos 0/b.png 0\n  my photos 0/c.png\r\nmy photos 0\\d.png\n");
  const auto scene = read("bundler");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 4U);
  EXPECT_EQ(scene->views[0].image_name, "my photos 0/a.png");
  EXPECT_EQ(scene->views[3].name, "my photos 0_d");
  fs::remove(path("bundler/my photos 0/b.png"));
  const Scene partial = read("bundler").value();
  EXPECT_EQ(partial.views.size(), 3U);
  EXPECT_EQ(partial.notes.at(0), "1 of 4 photographs is not there and left out: my photos 0/b.png");
  EXPECT_EQ(partial.points[0].views, (std::vector<int>{0, 2})) << "sightings by the absent one are left out";
}

TEST_F(SceneFolder, WrongFilesAreNamed) {
  change("mvsnet/cams/00000001_cam.txt", "intrinsic", "intrinsics");
  expect_bad_input(read("mvsnet"), {"00000001_cam.txt:7", "expected the word intrinsic"});
  change("mvsnet/cams/00000001_cam.txt", "intrinsics", "intrinsic");
  change("mvsnet/cams/00000001_cam.txt", "2.5 0.05", "2.5 -1");
  expect_bad_input(read("mvsnet"), {"00000001_cam.txt", "no range of depths"});
  change("mvsnet/cams/00000001_cam.txt", "2.5 -1", "2.5 0.05");
  change("mvsnet/pair.txt", "3 2 9.5", "3 7 9.5");
  EXPECT_EQ(read("mvsnet")->views[0].neighbors, (std::vector<int>{1, 3}));
  EXPECT_EQ(read("mvsnet")->notes.size(), 1U);
  fs::remove(path("mvsnet/images/00000001.png"));
  const Scene partial = read("mvsnet").value();
  EXPECT_EQ(partial.views.size(), 3U);
  EXPECT_EQ(partial.views[0].neighbors, (std::vector<int>{2})) << "view 3, which is the third one now";
  EXPECT_EQ(partial.notes.at(0), "1 of 4 photographs is not there and left out: 00000001");

  change("transforms/transforms.json", "transform_matrix", "matrix");
  expect_bad_input(read("transforms"), {"frame 0: transform_matrix"});
  change("transforms/transforms.json", "matrix", "transform_matrix");
  change("transforms/transforms.json", "\"fl_x\": 70", "\"fl_x\": \"70\"");
  expect_bad_input(read("transforms"), {"frame \"images/a.png\"", "fl_x is no number"});
  change("transforms/transforms.json", "\"fl_x\": \"70\"", "\"fl_x\": 70");
  change("transforms/transforms.json", "\"w\": 64", "\"w\": 640");
  expect_bad_input(read("transforms"), {"images/a.png", "is 64 x 48, its camera 640 x 48"});
  write_text(path("transforms/transforms.json"), "{\"frames\": [1]}");
  expect_bad_input(read("transforms"), {"frame 0: has no file_path"});
  write_text(path("transforms/transforms.json"), "{\"frames\": ");
  expect_bad_input(read("transforms"), {"is no JSON object"});

  change("bundler/bundle.out", "3 1 5", "3 9 5");
  expect_bad_input(read("bundler"), {"bundle.out:", "camera 9 of 5"});
  change("bundler/bundle.out", "5 3\n", "5 4\n");
  change("bundler/bundle.out", "3 9 5", "3 1 5");
  expect_bad_input(read("bundler"), {"bundle.out:", "a coordinate is missing"});
  write_text(path("bundler/list.txt"), "images/a.png\n");
  change("bundler/bundle.out", "5 4\n", "5 3\n");
  expect_bad_input(read("bundler"), {"list.txt", "names 1 images"});
  write_text(path("bundler/bundle.out"), "# v0.3\n");
  expect_bad_input(read("bundler"), {"# Bundle file"});
}

}  // namespace
}  // namespace quorum
