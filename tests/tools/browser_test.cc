// What a run leaves, opened by the programs that people open it with: pages and models in a headless Chromium, models
// in the Khronos validator. These are no part of the project's packages; a test is skipped where they are not there.
#include <cstdlib>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

/// Takes node and chromium of Debian, and playwright-core and gltf-validator of npm, in a folder that NODE_PATH names.
class Browser : public ToolTest {
 protected:
  void SetUp() override {
    for (const char* program : {"/usr/bin/node", "/usr/bin/chromium"})
      if (!std::filesystem::exists(program)) GTEST_SKIP() << program << " is not there";
    const char* modules = std::getenv("NODE_PATH");
    for (const char* module : {"playwright-core", "gltf-validator"})
      if (modules == nullptr || !std::filesystem::exists(std::filesystem::path(modules) / module))
        GTEST_SKIP() << module << " is not in NODE_PATH (npm install " << module << ")";
  }

  static ProgramResult run_script(const std::string& name, const std::filesystem::path& file) {
    return Program("/usr/bin/node", {(source_folder() / "tests/tools/browser" / name).string(), file.string()}).wait();
  }

  void reconstruct() {
    synthesize(12, 200);
    const ProgramResult done = quorum_program({"reconstruct", scene().string(), "-o", below("result").string(),
                                               "--device", "cpu", "--texture", "--report", "--quiet"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
};

TEST_F(Browser, TheReportIsReadWithMouseAndKeyboardOnAPhoneAndWithoutWebGl) {
  ASSERT_NO_FATAL_FAILURE(reconstruct());
  const ProgramResult read = run_script("report_page.cjs", below("result/report.html"));
  EXPECT_EQ(read.exit_code, 0) << read.err;
}

TEST_F(Browser, TheModelOpensInThreeJsAndTheValidatorFindsNoError) {
  ASSERT_NO_FATAL_FAILURE(reconstruct());
  const ProgramResult seen = run_script("view_glb.cjs", below("result/model.glb"));
  EXPECT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_TRUE(contains(seen.out, "\"textures\":1")) << seen.out;
  const ProgramResult valid = run_script("validate_glb.cjs", below("result/model.glb"));
  EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
}

}  // namespace
}  // namespace quorum
