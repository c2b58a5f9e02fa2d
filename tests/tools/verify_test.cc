// quorum verify OUT as a user runs it.
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class VerifyRun : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 96); }
  [[nodiscard]] std::filesystem::path result() const { return below("result"); }

  ProgramResult reconstruct() {
    return quorum_program({"reconstruct",
                           scene().string(),
                           "-o",
                           result().string(),
                           "--device",
                           "cpu",
                           "--quiet",
                           "--window",
                           "7",
                           "--neighbors",
                           "3",
                           "--bounds",
                           "-0.05",
                           "-0.05",
                           "-0.0375",
                           "0.05",
                           "0.12",
                           "0.0375",
                           "--min-component",
                           "0",
                           "--maps",
                           "needed"});
  }
  ProgramResult verify(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"verify",  result().string(), "--scene", scene().string(),
                                          "--quiet", "--device",        "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }
};

TEST_F(VerifyRun, TheSameRunIsEqualAndSaysOnWhat) {
  ASSERT_EQ(reconstruct().exit_code, 0);
  const ProgramResult done = verify({"--threads", "1", "--simd", "baseline"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "equal")) << done.out;
  EXPECT_TRUE(contains(file_bytes(result() / "verified.json"), "CPU, 1 thread")) << done.out;
  ASSERT_EQ(reconstruct().exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(result() / "verified.json"));  // it told of the run before
}

TEST_F(VerifyRun, AChangedMapIsNamedWithItsStage) {
  ASSERT_EQ(reconstruct().exit_code, 0);
  const auto map = result() / "depth" / "temple0003.depth.pfm";
  std::string bytes = file_bytes(map);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_text(map, bytes);
  expect_failure(verify(), 1, {"temple0003.depth.pfm", "depth maps"});
  EXPECT_FALSE(std::filesystem::exists(result() / "verified.json"));
}

TEST_F(VerifyRun, OtherPhotographsAreToldFromAnotherResult) {
  ASSERT_EQ(reconstruct().exit_code, 0);
  std::filesystem::copy_file(scene() / "temple0001.png", scene() / "temple0002.png",
                             std::filesystem::copy_options::overwrite_existing);
  expect_failure(verify(), 3, {"depth.json", "other files"});
}

TEST_F(VerifyRun, ADamagedRecordOfTheRunIsRefusedWithItsName) {
  ASSERT_EQ(reconstruct().exit_code, 0);
  const std::string good = file_bytes(result() / "run.json");
  std::string other = good;
  other.replace(other.find("\"window\": 7"), 11, "\"window\": 8");
  for (const std::string& bad : {std::string("{"), std::string(R"({"version": 3, "options": 5})"), other}) {
    write_text(result() / "run.json", bad);
    expect_failure(verify(), 3, {"run.json"});
  }
}

TEST_F(VerifyRun, WithoutARunOrASceneItSaysSo) {
  expect_failure(verify(), 3, {"run.json", "quorum reconstruct"});
  expect_failure(quorum_program({"verify", result().string()}), 2, {"--scene"});
}

}  // namespace
}  // namespace quorum
