// quorum bench as a user starts it.
#include <nlohmann/json.hpp>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Bench : public ToolTest {
 protected:
  ProgramResult bench(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"bench", scene().string(), "--device", "cpu", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }
};

TEST_F(Bench, CostsStandBesideTheirLimits) {
  synthesize(8, 96);
  const auto file = below("bench.json");
  const ProgramResult result = bench({"-o", file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto json = nlohmann::json::parse(file_bytes(file), nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << file_bytes(file);
  EXPECT_EQ(json["scene"]["views"], 8);
  EXPECT_GT(json["rates"]["operations_per_second"].get<double>(), 1e8);
  EXPECT_GT(json["rates"]["bytes_per_second"].get<double>(), 1e7);
  EXPECT_GT(json["peak_memory_bytes"].get<double>(), 1e6);
  ASSERT_EQ(json["costs"].size(), 7U);
  for (const auto& cost : json["costs"]) {
    EXPECT_GT(cost["units"].get<double>(), 0.0) << cost;
    EXPECT_GT(cost["nanoseconds_per_unit"].get<double>(), 0.0) << cost;
    EXPECT_GT(cost["limit_nanoseconds_per_unit"].get<double>(), 0.0) << cost;
    EXPECT_TRUE(contains(result.out, cost["formula"].get<std::string>())) << cost;
  }

  const ProgramResult compared = quorum_program({"bench", "--compare", file.string(), file.string()});
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_TRUE(contains(compared.out, "sweep_depth, ns a unit")) << compared.out;
  EXPECT_TRUE(contains(compared.out, "1.000")) << compared.out;
}

TEST_F(Bench, ReportThatIsNoneIsRefusedBeforeAnythingRuns) {
  write_text(below("other.json"), "{}");
  expect_failure(bench({"--compare", below("other.json").string()}), 3, {"other.json", "quorum bench -o"});
  expect_failure(bench({"--compare", below("none.json").string()}), 3, {"none.json"});
}

TEST_F(Bench, MissingSceneIsNamed) { expect_failure(bench({}), 3, {scene().string(), "no such folder"}); }

}  // namespace
}  // namespace quorum
