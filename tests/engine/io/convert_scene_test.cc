#include "engine/io/convert_scene.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "engine/io/output_folder.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/colmap_scene.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && !entry.is_symlink())
      files.emplace(fs::relative(entry.path(), folder).string(), read_file(entry.path()).value());
  return files;
}

class ConvertSceneTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  /// The scene with its images under other names; the files stay where they are.
  Scene scene_with_names(const std::vector<std::string>& names) {
    write_colmap_scene(path("scene"), model_);
    Scene scene = read_colmap(path("scene"), {}).value();
    scene.bounds = {{-1, -1, -1}, {1, 1, 1}};
    for (std::size_t i = 0; i < names.size(); ++i) scene.views[i].image_name = names[i];
    return scene;
  }
  std::vector<std::string> pictures() {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in(path("out")))
      if (name.starts_with("images/")) names.push_back(name.substr(7));
    return names;
  }

  TemporaryFolder folder_;
  ColmapModel model_ = make_colmap_model("PINHOLE");
};

using ConvertScene = ConvertSceneTest;
constexpr ConvertedFormat kFormats[] = {ConvertedFormat::kColmap, ConvertedFormat::kColmapText,
                                        ConvertedFormat::kMvsnet, ConvertedFormat::kTransforms};

TEST_F(ConvertScene, OrdinaryNamesAreKept) {
  const Scene scene = scene_with_names({"a.png", "left/b.png", "my photos/c.png", "d.png"});
  ASSERT_TRUE(convert_scene(path("out"), scene, ConvertedFormat::kColmap));
  EXPECT_EQ(pictures(), (std::vector<std::string>{"a.png", "d.png", "left/b.png", "my photos/c.png"}));
  EXPECT_TRUE(read_colmap(path("out"), {}));
}

TEST_F(ConvertScene, NamesThatLeaveTheFolderDoNot) {
  const Scene scene =
      scene_with_names({path("scene/images/a.png").string(), "../../scene/images/b.png", "x\\c.png", "D.png"});
  const auto before = files_in(path("scene"));
  for (const ConvertedFormat format : kFormats) {
    fs::remove_all(path("out"));
    const auto done = convert_scene(path("out"), scene, format);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(pictures().size(), 4U);
    EXPECT_EQ(files_in(path("scene")), before);
  }
  EXPECT_EQ(pictures(), (std::vector<std::string>{"a.png", "b.png", "c.png", "d.png"}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 2);
}

TEST_F(ConvertScene, WhatIsThereAndNotOursStays) {
  const Scene scene = scene_with_names({});
  fs::create_directories(path("out/images"));
  write_text(path("out/images/c.png"), "mine");
  for (const ConvertedFormat format : {ConvertedFormat::kColmap, ConvertedFormat::kTransforms})
    expect_bad_input(convert_scene(path("out"), scene, format), {"out/images/c.png", "choose another output folder"});
  EXPECT_EQ(read_file(path("out/images/c.png")).value(), "mine");
  fs::remove_all(path("out"));
  fs::create_directories(path("out"));
  fs::create_directory_symlink(path("scene/images"), path("out/images"));
  const auto before = files_in(path("scene"));
  expect_bad_input(convert_scene(path("out"), scene, ConvertedFormat::kMvsnet), {"out/images", "is a link"});
  fs::remove(path("out/images"));
  fs::create_directories(path("out/images"));
  fs::create_symlink(path("scene/images/a.png"), path("out/images/a.png"));
  expect_bad_input(convert_scene(path("out"), scene, ConvertedFormat::kColmap), {"out/images/a.png"});
  EXPECT_TRUE(fs::is_symlink(path("out/images/a.png")));
  EXPECT_EQ(files_in(path("scene")), before);
}

TEST_F(ConvertScene, OntoItselfIsRefusedBeforeTheModelIsReplaced) {
  model_ = make_colmap_model("SIMPLE_RADIAL");
  const Scene scene = scene_with_names({});
  const auto before = files_in(path("scene"));
  expect_bad_input(convert_scene(path("scene"), scene, ConvertedFormat::kColmap), {"is there already"});
  EXPECT_EQ(files_in(path("scene")), before);
}

TEST_F(ConvertScene, CanBeDoneAgain) {
  Scene scene = scene_with_names({});
  ASSERT_TRUE(convert_scene(path("out"), scene, ConvertedFormat::kColmap));
  scene.bounds.high.x() = 2.0;
  scene.views.pop_back();
  for (SparsePoint& point : scene.points) std::erase(point.views, 3);
  ASSERT_TRUE(convert_scene(path("out"), scene, ConvertedFormat::kColmap));
  EXPECT_EQ(read_colmap(path("out"), {})->views.size(), 3U);
}

TEST(OutputFolder, KnowsItsOwnFilesAfterwards) {
  const TemporaryFolder folder;
  ASSERT_TRUE(OutputFolder::open(folder.path() / "out")->write("a/b.txt", "1"));
  auto again = OutputFolder::open(folder.path() / "out").value();
  EXPECT_TRUE(again.write("a/b.txt", "2"));
  EXPECT_EQ(read_file(folder.path() / "out/a/b.txt").value(), "2");
  write_text(folder.path() / "out/c.txt", "3");
  EXPECT_TRUE(again.write("c.txt", "3")) << "the same bytes";
  expect_bad_input(again.write("c.txt", "4"), {"c.txt", "is there already"});
}

}  // namespace
}  // namespace quorum
