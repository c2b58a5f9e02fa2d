// The estimates of memory against what runs hold.
#include <nlohmann/json.hpp>

#include "tests/support/sanitizer.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Memory : public ToolTest {
 protected:
  nlohmann::json run(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", below("result").string(), "--device",
                                          "cpu",         "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = quorum_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(file_bytes(below("result") / "run.json"), nullptr, false);
  }
};

TEST_F(Memory, ARunHoldsWhatWasEstimatedAndNotMuchLess) {
  if (freed_memory_is_kept()) GTEST_SKIP() << "the sanitizer keeps freed memory";
  synthesize(5, 800);
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--step-pixels", "4"},
                                               {"--step-pixels", "4", "--window-model", "plane", "--cloud", "--colmap"},
                                               {"--step-pixels", "4", "--voxel-size", "0.3mm", "--fill-holes"}}) {
    const auto report = run(more);
    const double peak = report["peak_memory_bytes"].get<double>();
    const double estimate = report["estimated_memory_bytes"].get<double>();
    EXPECT_LE(peak, estimate) << more.back();
    EXPECT_GE(peak, 0.4 * estimate) << more.back();
  }
}

}  // namespace
}  // namespace quorum
