// The program of a build without Vulkan, QUORUM_VULKAN=OFF.
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class WithoutVulkan : public ToolTest {
 protected:
  static ProgramResult run(const std::vector<std::string>& arguments) {
    const std::filesystem::path program = built_program("quorum_without_vulkan");
    return Program(std::filesystem::exists(program) ? program : built_program("quorum"), arguments).wait();
  }
};

TEST_F(WithoutVulkan, TheCpuIsAllThatThereIs) {
  const ProgramResult listed = run({"devices"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_TRUE(contains(listed.out, "this build has no Vulkan")) << listed.out;
  synthesize(4, 64);
  expect_failure(run({"reconstruct", scene().string(), "-o", below("out").string(), "--device", "0"}), 4,
                 {"--device 0", "QUORUM_VULKAN=ON"});
}

TEST_F(WithoutVulkan, ResultsAreThoseOfTheFullProgram) {
  synthesize(8, 160);
  const auto reconstruct = [&](const std::string& output) {
    return std::vector<std::string>{"reconstruct", scene().string(), "-o", below(output).string(), "--quiet"};
  };
  const ProgramResult without = run(reconstruct("without"));
  ASSERT_EQ(without.exit_code, 0) << without.err;
  const ProgramResult full = quorum_program(reconstruct("full"));
  ASSERT_EQ(full.exit_code, 0) << full.err;
  const std::string mesh = file_bytes(below("without") / "mesh.ply");
  EXPECT_GT(mesh.size(), 10'000U);
  EXPECT_TRUE(mesh == file_bytes(below("full") / "mesh.ply"));
}

}  // namespace
}  // namespace quorum
