// quorum simplify as a user runs it.
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Simplify : public ToolTest {
 protected:
  void SetUp() override { synthesize(3, 64); }
  [[nodiscard]] std::string truth() const { return (scene() / "gt.ply").string(); }
};

TEST_F(Simplify, WritesFewerTrianglesAndSaysHowFarTheyDeviate) {
  const ProgramResult done =
      quorum_program({"simplify", truth(), "-o", below("few.glb").string(), "--triangles", "2k"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "triangles")) << done.out;
  EXPECT_TRUE(contains(done.out, "deviation")) << done.out;
  EXPECT_LT(std::filesystem::file_size(below("few.glb")), std::filesystem::file_size(truth()) / 2);
}

TEST_F(Simplify, WithoutAnAimOnlyTheFormatChanges) {
  const ProgramResult done = quorum_program({"simplify", truth(), "-o", below("same.ply").string()});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(std::filesystem::file_size(below("same.ply")), std::filesystem::file_size(truth()));
}

TEST_F(Simplify, WrongWordsAreRefusedBeforeAnyWork) {
  expect_failure(quorum_program({"simplify", truth(), "-o", below("a.fbx").string()}), 2, {"a.fbx", ".glb"});
  expect_failure(quorum_program({"simplify", truth(), "-o", below("a.ply").string(), "--triangles", "many"}), 2,
                 {"--triangles many", "500k"});
  expect_failure(quorum_program({"simplify", truth(), "-o", below("a.ply").string(), "--error", "-1mm"}), 2,
                 {"--error -1mm"});
  expect_failure(quorum_program({"simplify", "absent.ply", "-o", below("a.ply").string()}), 3, {"absent.ply"});
}

}  // namespace
}  // namespace quorum
