// quorum texture as a user runs it.
#include "tests/support/test_support.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class TextureCommand : public ToolTest {
 protected:
  void SetUp() override { synthesize(6, 112); }
  [[nodiscard]] std::string truth() const { return (scene() / "gt.ply").string(); }
  ProgramResult texture(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "texture", truth(), "--scene", scene().string(), "--quiet", "-o", below(output).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }
};

TEST_F(TextureCommand, WritesGlbThatRenderDrawsAsThePhotograph) {
  const ProgramResult done = texture("mesh.glb");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "unseen")) << done.out;
  EXPECT_TRUE(contains(done.out, "of 6 photographs")) << done.out;
  const ProgramResult drawn =
      quorum_program({"render", below("mesh.glb").string(), "--scene", scene().string(), "--view", "temple0003",
                      "--shading", "color", "--compare", "-o", below("view.png").string()});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  ASSERT_TRUE(drawn.out.starts_with("PSNR ")) << drawn.out;
  EXPECT_GT(std::stod(drawn.out.substr(5)), 20) << drawn.out;
}

TEST_F(TextureCommand, TheTruthIsDrawnFromAllSides) {
  const auto around = [&](const std::string& count, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "render",      truth(), "--scene", scene().string(),        "--view", "temple0003",
        "--turntable", count,   "-o",      below("around").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  };
  const ProgramResult done = around("4");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto files = files_below(below("around"));
  ASSERT_EQ(files.size(), 4U);
  const ProgramResult one = quorum_program(
      {"render", truth(), "--scene", scene().string(), "--view", "temple0003", "-o", below("one.png").string()});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(files.at("0000.png"), file_bytes(below("one.png")));
  EXPECT_NE(files.at("0002.png"), files.at("0000.png"));
  expect_failure(around("4", {"--compare"}), 2, {"--compare", "--turntable"});
  expect_failure(around("1"), 2, {"--turntable"});
  std::filesystem::copy_file(truth(), below("around") / "0001.png", std::filesystem::copy_options::overwrite_existing);
  ProgramResult kept = quorum_program({"render", (below("around") / "0001.png").string(), "--scene", scene().string(),
                                       "--view", "temple0003", "--turntable", "2", "-o", below("around").string()});
  expect_failure(kept, 2, {"0001.png", "input"});
}

TEST_F(TextureCommand, AnyNumberOfThreadsGivesTheSameBytes) {
  ASSERT_EQ(texture("one.glb", {"--threads", "1"}).exit_code, 0);
  ASSERT_EQ(texture("many.glb").exit_code, 0);
  EXPECT_EQ(file_bytes(below("one.glb")), file_bytes(below("many.glb")));
}

TEST_F(TextureCommand, PhotographsGoneSinceAreTold) {
  std::filesystem::remove(scene() / "temple0003.png");
  const ProgramResult done =
      quorum_program({"texture", truth(), "--scene", scene().string(), "-o", below("mesh.glb").string()});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.err, "temple0003.png")) << done.err;
}

TEST_F(TextureCommand, ObjHasItsPicturesBesideIt) {
  ASSERT_EQ(texture("mesh.obj", {"--pages", "png"}).exit_code, 0);
  EXPECT_TRUE(contains(file_bytes(below("mesh.obj")), "mtllib mesh.mtl"));
  EXPECT_TRUE(std::filesystem::exists(below("mesh-1.png")));
}

TEST_F(TextureCommand, WhatCanNotBeDoneIsALineAndACode) {
  expect_failure(texture("mesh.ply"), 2, {"mesh.ply", ".glb"});
  expect_failure(texture("mesh.glb", {"--size", "100"}), 2, {"--size 100", "256"});
  expect_failure(texture("mesh.glb", {"--memory", "20MiB"}), 5, {"texturing the mesh", "--memory"});
  write_text(below("cloud.ply"),
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n0 0 0\n");
  expect_failure(quorum_program({"texture", below("cloud.ply").string(), "--scene", scene().string(), "--quiet", "-o",
                                 below("mesh.glb").string()}),
                 3, {"cloud.ply", "no triangles"});
  write_text(below("far.ply"),
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
             "70 0 0\n71 0 0\n70 1 0\n3 0 1 2\n");
  expect_failure(quorum_program({"texture", below("far.ply").string(), "--scene", scene().string(), "--quiet", "-o",
                                 below("mesh.glb").string()}),
                 3, {"far.ply", "no photograph shows"});
  EXPECT_FALSE(std::filesystem::exists(below("mesh.glb")));
  std::filesystem::remove(scene() / "temple0002.png");
  const ProgramResult gone = texture("mesh.glb");
  EXPECT_EQ(gone.exit_code, 0) << gone.err;  // the others are there
}

TEST_F(TextureCommand, ReconstructWritesAModelOfFewerTriangles) {
  std::filesystem::remove_all(scene());
  synthesize(8, 192);
  std::vector<std::string> arguments = {
      "reconstruct", scene().string(), "-o", below("out").string(), "--device", "cpu", "--quiet",
      "--texture",   "--triangles",    "2k", "--step-pixels",       "4"};
  arguments.insert(arguments.end(), kKeepAll.begin(), kKeepAll.end());
  const ProgramResult done = quorum_program(arguments);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string model = file_bytes(below("out") / "model.glb");
  EXPECT_TRUE(model.starts_with("glTF"));
  EXPECT_TRUE(contains(model, "TEXCOORD_0"));
  EXPECT_LT(model.size(), file_bytes(below("out") / "mesh.ply").size());
}

}  // namespace
}  // namespace quorum
