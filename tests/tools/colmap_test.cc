// COLMAP models and plain photographs as a user gives them.
#include "engine/io/write_image.h"
#include "tests/support/colmap_scene.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class ColmapTool : public ToolTest {
 protected:
  ProgramResult reconstruct(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", below("result").string(), "--device",
                                          "cpu",         "--quiet"};
    arguments.insert(arguments.end(), kKeepAll.begin(), kKeepAll.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }
};

TEST_F(ColmapTool, ModelIsReconstructedWithItsCloudAndWorkspace) {
  write_colmap_scene(scene(), make_colmap_model("SIMPLE_RADIAL"));
  expect_failure(reconstruct({"--colmap"}), 3, {"the mesh is empty"});  // its photographs show no one thing
  const auto files = files_below(below("result"));
  EXPECT_TRUE(files.contains("mesh.ply"));
  EXPECT_TRUE(files.contains("colmap/sparse/points3D.bin"));
  EXPECT_TRUE(files.contains("colmap/images/a.png"));
  EXPECT_TRUE(files.contains("colmap/stereo/depth_maps/d.png.geometric.bin"));
  EXPECT_TRUE(files.contains("colmap/stereo/fusion.cfg"));
}

TEST_F(ColmapTool, BadModelsAreRefusedOnOneLine) {
  write_colmap_scene(scene(), make_colmap_model("OPENCV"));
  const std::string images = file_bytes(scene() / "sparse" / "images.bin");
  write_text(scene() / "sparse" / "images.bin", images.substr(0, 300));
  expect_failure(reconstruct(), 3, {"images.bin", "cut off"});
  write_text(scene() / "sparse" / "images.bin", images);
  write_png(scene() / "images" / "b.png", ColorImage(20, 20)).value();
  expect_failure(reconstruct(), 3, {"b.png", "is 20 x 20, its camera 65 x 48"});
  write_png(scene() / "images" / "b.png", ColorImage(65, 48)).value();
  std::filesystem::create_directories(below("masks"));
  expect_failure(reconstruct({"--masks", below("masks").string()}), 3, {"no mask a.png.png"});
  for (int i = 0; i < 4; ++i)
    write_png(below("masks") / (std::string(1, static_cast<char>('a' + i)) + ".png"), ColorImage(9, 9)).value();
  expect_failure(reconstruct({"--masks", below("masks").string()}), 3, {"a.png: is 9 x 9, expected 64 x 48"});
  expect_failure(reconstruct({"--format", "bundler"}), 3, {"bundle.out"});
  expect_failure(reconstruct({"--roi", below("none.txt").string()}), 3, {"none.txt"});
}

TEST_F(ColmapTool, PhotosSaysWhenColmapIsNotInstalled) {
  std::filesystem::create_directories(scene());
  for (const char* name : {"a.png", "b.png", "c.png"}) write_png(scene() / name, ColorImage(64, 48)).value();
  ProgramSetting setting;
  setting.environment = {{"PATH", below("nothing").string()}};
  expect_failure(
      quorum_program({"photos", scene().string(), "-o", below("result").string(), "--device", "cpu", "--quiet"},
                     setting),
      3, {"colmap is not installed", "apt install colmap"});
  std::filesystem::remove(scene() / "c.png");
  expect_failure(quorum_program({"photos", scene().string(), "-o", below("result").string(), "--quiet"}, setting), 3,
                 {"holds 2 photographs"});
}

}  // namespace
}  // namespace quorum
