// Where the model and the photographs of a COLMAP scene stand.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/io/image_file.h"
#include "engine/io/scene_folder.h"
#include "tests/engine/io/colmap_test.h"
#include "tests/engine/io/io_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

using ColmapFolders = ColmapTest;

TEST_F(ColmapFolders, ModelIsFoundWhereItUsuallyStands) {
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

TEST_F(ColmapFolders, ModelIsFoundWhereNerfstudioAndGaussianSplattingKeepIt) {
  for (const char* kept : {"colmap", "distorted"}) {
    const TemporaryFolder folder;
    write_colmap_scene(folder.path(), make_colmap_model("OPENCV"));
    fs::create_directories(folder.path() / kept / "sparse");
    fs::rename(folder.path() / "sparse", folder.path() / kept / "sparse/0");
    EXPECT_EQ(recognize_format(folder.path()), SceneFormat::kColmap);
    const auto scene = read_scene(folder.path(), {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->views.size(), 4U);
    EXPECT_EQ(scene->views[0].image_path, folder.path() / "images/a.png");
    EXPECT_TRUE(read_colmap(folder.path(), {}, fs::path(kept) / "sparse/0"));
    EXPECT_TRUE(read_colmap(folder.path() / kept, {})) << "photographs beside the folder";
    write_text(folder.path() / "transforms.json", "{}");
    EXPECT_EQ(recognize_format(folder.path()), SceneFormat::kTransforms) << "made of that model";
  }
}

TEST_F(ColmapFolders, ADistortedModelHasItsPhotographsInInput) {
  write(make_colmap_model("OPENCV"));
  fs::create_directories(path("distorted/sparse"));
  fs::rename(path("sparse"), path("distorted/sparse/0"));
  fs::copy(path("images"), path("input"));
  EXPECT_EQ(read().value().views[1].image_path, path("input/b.png")) << "those in images are without distortion";
}

TEST_F(ColmapFolders, LargestOfSeveralModelsIsTakenAndSaid) {
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

TEST_F(ColmapFolders, ImagesMayStandElsewhere) {
  write(make_colmap_model("PINHOLE"));
  fs::rename(path("images"), path("photos"));
  EXPECT_FALSE(read());
  const auto scene = read_colmap(folder_.path(), path("photos"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views[2].image_path, path("photos/c.png"));
}

}  // namespace
}  // namespace quorum
