// Files of the user's stay as they are: what a command would lose is refused in a line.
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

class KeptFiles : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 80); }

  ProgramResult reconstruct(const fs::path& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", output.string(), "--device",
                                          "cpu",         "--quiet"};
    arguments.insert(arguments.end(), kKeepAll.begin(), kKeepAll.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }
};

TEST_F(KeptFiles, AMeshAndACloudOfAnotherProgramStay) {
  for (const char* name : {"mesh.ply", "fused.ply"}) {
    write_text(scene() / name, "mine");
    expect_failure(reconstruct(scene()), 3, {name, "was not written by quorum", "choose another output folder"});
    expect_failure(quorum_program({"depth", scene().string(), "-o", scene().string(), "--device", "cpu", "--quiet"}), 3,
                   {name, "was not written by quorum"});
    EXPECT_EQ(file_bytes(scene() / name), "mine");
    fs::remove(scene() / name);
  }
  EXPECT_EQ(reconstruct(scene()).exit_code, 0);
  EXPECT_EQ(reconstruct(scene(), {"--cloud"}).exit_code, 0) << "its own are replaced";
}

TEST_F(KeptFiles, AModelOfAnotherProgramStays) {
  fs::create_directories(below("out/colmap/sparse"));
  write_text(below("out/colmap/sparse/cameras.bin"), "mine");
  expect_failure(reconstruct(below("out"), {"--colmap"}), 3, {"sparse/cameras.bin", "was not written by quorum"});
  EXPECT_EQ(file_bytes(below("out/colmap/sparse/cameras.bin")), "mine");
  fs::remove_all(below("out/colmap"));
  for (int run = 0; run < 2; ++run) EXPECT_EQ(reconstruct(below("out"), {"--colmap"}).exit_code, 0);
}

TEST_F(KeptFiles, NoInputIsReplacedByAPicture) {
  const std::string mesh = (scene() / "gt.ply").string();
  for (const char* name : {"temple0001.png", "temple0002.png"}) {
    const std::string bytes = file_bytes(scene() / name);
    expect_failure(quorum_program({"render", mesh, "--scene", scene().string(), "--view", "temple0001", "-o",
                                   (scene() / name).string()}),
                   2, {name, "is an input"});
    EXPECT_EQ(file_bytes(scene() / name), bytes);
  }
  const std::string bytes = file_bytes(mesh);
  expect_failure(quorum_program({"simplify", mesh, "-o", (scene() / "../scene/gt.ply").string(), "--triangles", "9"}),
                 2, {"gt.ply", "is an input"});
  EXPECT_EQ(file_bytes(mesh), bytes);
}

TEST_F(KeptFiles, AnEmptyWordIsNoFolder) {
  expect_failure(reconstruct(""), 2, {"--output: is empty", "leave it out"});
  expect_failure(reconstruct(below("out"), {"--masks", ""}), 2, {"--masks: is empty"});
  EXPECT_FALSE(fs::exists(below("out")));
}

TEST_F(KeptFiles, CommandsThatOnlyLookMakeNoFolder) {
  const std::string none = below("none").string();
  expect_failure(quorum_program({"report", none, "--scene", scene().string()}), 3, {"no finished run"});
  expect_failure(quorum_program({"calibrate", scene().string(), (scene() / "gt.ply").string(), "-o", none}), 3,
                 {"holds no depths"});
  EXPECT_FALSE(fs::exists(none));
}

TEST_F(KeptFiles, APageOfAnotherProgramStays) {
  ASSERT_EQ(reconstruct(below("out")).exit_code, 0);
  write_text(below("out/report.html"), "<html>mine</html>");
  expect_failure(quorum_program({"report", below("out").string(), "--scene", scene().string()}), 3,
                 {"report.html", "was not written by quorum"});
  EXPECT_EQ(file_bytes(below("out/report.html")), "<html>mine</html>");
  fs::remove(below("out/report.html"));
  for (int run = 0; run < 2; ++run)
    EXPECT_EQ(quorum_program({"report", below("out").string(), "--scene", scene().string()}).exit_code, 0);
}

TEST_F(KeptFiles, ADepthMapThatWasCutIsMadeAnewAndOneThatIsGoneIsTold) {
  ASSERT_EQ(reconstruct(below("out")).exit_code, 0);
  const std::string mesh = file_bytes(below("out/mesh.ply"));
  fs::resize_file(below("out/depth/temple0002.depth.pfm"), 100);
  fs::remove(below("out/depth/temple0003.confidence.pfm"));
  EXPECT_EQ(reconstruct(below("out")).exit_code, 0);
  EXPECT_EQ(file_bytes(below("out/mesh.ply")), mesh);
  fs::remove(below("out/depth/temple0002.depth.json"));
  const ProgramResult fused =
      quorum_program({"fuse", scene().string(), "-o", below("out").string(), "--device", "cpu"});
  EXPECT_TRUE(contains(fused.err, "1 of 8 views have no depth map here and take no part: temple0002")) << fused.err;
}

TEST_F(KeptFiles, FormatsToConvertToAreListed) {
  expect_failure(quorum_program({"convert", scene().string(), "--to", "nerf", "-o", below("out").string()}), 2,
                 {"--to nerf: give colmap, colmap-text, mvsnet or nerfstudio"});
}

}  // namespace
}  // namespace quorum
