// quorum plan against runs, and progress for programs.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Plans : public ToolTest {
 protected:
  std::string plan(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"plan", scene().string()};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = quorum_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
};

double number_after(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + what.size()));
}

TEST_F(Plans, SizesAreThoseOfTheRunAboutAndShardsFollowFromTime) {
  synthesize(8, 320);
  const std::string text = plan({"--time", "1h", "--threads", "1"});
  for (const std::string part :
       {"views        8", "pixels       0.6 million", "memory", "disk", "CPU time", "shards       1 with 1 threads"})
    EXPECT_TRUE(contains(text, part)) << part << " is not in: " << text;
  ASSERT_EQ(quorum_program({"reconstruct", scene().string(), "-o", below("o").string(), "--device", "cpu", "--quiet"})
                .exit_code,
            0);
  const auto report = nlohmann::json::parse(file_bytes(below("o") / "run.json"), nullptr, false);
  const double blocks = report["volume"]["blocks"].get<double>();
  EXPECT_GT(number_after(text, "about "), blocks / 2);
  EXPECT_LT(number_after(text, "about "), blocks * 2);
  expect_failure(quorum_program({"plan", scene().string(), "--time", "soon"}), 2, {"--time soon", "30min"});
}

TEST_F(Plans, ProgressForProgramsIsAnObjectALine) {
  synthesize(4, 96);
  const ProgramResult result =
      quorum_program({"reconstruct", scene().string(), "-o", below("o").string(), "--device", "cpu", "--progress",
                      "json", "--quality", "draft", "--min-component", "0", "--min-confidence", "0"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.err);
  int steps = 0;
  double percent = 0.0;
  for (std::string line; std::getline(lines, line);) {
    const auto event = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(event.is_object()) << line;
    if (event["event"] != "step") continue;
    ++steps;
    EXPECT_GE(event["run_percent"].get<double>(), percent) << line;
    percent = event["run_percent"].get<double>();
  }
  EXPECT_GE(steps, 12);
  EXPECT_GE(percent, 99.0);
  const auto report = nlohmann::json::parse(file_bytes(below("o") / "run.json"), nullptr, false);
  EXPECT_EQ(report["options"]["neighbors"], 3);
  EXPECT_EQ(report["options"]["window_model"], "plane");
}

TEST_F(Plans, WhatIsGivenBesideAQualityOverrulesIt) {
  synthesize(4, 96);
  ASSERT_EQ(quorum_program({"depth", scene().string(), "-o", below("o").string(), "--device", "cpu", "--neighbors", "2",
                            "--quality", "high", "--quiet"})
                .exit_code,
            0);
  const auto report = nlohmann::json::parse(file_bytes(below("o") / "run.json"), nullptr, false);
  EXPECT_EQ(report["options"]["neighbors"], 2);
  EXPECT_EQ(report["options"]["second_window"], 9);
}

TEST_F(Plans, PicturesTakeTheFormatOfTheirEndingAndViewsTheNameOfTheirPhotograph) {
  synthesize(3, 64);
  const auto render = [&](const std::string& view, const std::string& picture) {
    return quorum_program({"render", (scene() / "gt.ply").string(), "--scene", scene().string(), "--view", view, "-o",
                           below(picture).string()});
  };
  EXPECT_EQ(render("temple0001.png", "a.png").exit_code, 0);
  EXPECT_TRUE(file_bytes(below("a.png")).starts_with("\x89PNG"));
  EXPECT_EQ(render("temple0001", "a.JPG").exit_code, 0);
  EXPECT_TRUE(file_bytes(below("a.JPG")).starts_with("\xff\xd8"));
  expect_failure(render("temple0001", "a.xyz"), 2, {"a.xyz", ".png"});
  expect_failure(render("temple001", "a.png"), 2, {"did you mean temple0001?"});
}

}  // namespace
}  // namespace quorum
