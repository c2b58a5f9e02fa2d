#include "engine/pipeline/run_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

#include "engine/io/file.h"
#include "engine/pipeline/run_json.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

const RunOption& option_named(std::string_view name) {
  const auto option = std::ranges::find(run_option_table(), name, &RunOption::name);
  EXPECT_NE(option, run_option_table().end()) << name;
  return *option;
}

RunOptions with(std::string_view name, const std::vector<std::string>& words) {
  RunOptions options;
  EXPECT_TRUE(option_named(name).parse(options, words)) << name;
  return options;
}

TEST(RunOptions, DefaultsAreInRangeAndNamesAreUnique) {
  EXPECT_TRUE(RunOptions{}.check());
  std::set<std::string> names;
  for (const RunOption& option : run_option_table()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_EQ(option.values.empty(), option.most_words == 0) << option.name;
  }
  EXPECT_GT(names.size(), 30U);
}

TEST(RunOptions, WhatIsToldIsReadBack) {
  for (const auto& [name, word] : {std::pair{"neighbors", "7"},
                                   {"threshold", "0.75"},
                                   {"threshold", "0.99"},
                                   {"window-model", "axis"},
                                   {"depth-step", "0.0025"},
                                   {"min-confidence", "0.5"},
                                   {"min-confidence", "auto"},
                                   {"weights", "confidence,border"},
                                   {"weights", "none"},
                                   {"memory", "auto"},
                                   {"simd", "baseline"},
                                   {"bounds", "0 1 2 3 4.5 6"},
                                   {"masks", "a/b"}})
    EXPECT_EQ(option_named(name).text(with(name, {word})), word) << name;
  EXPECT_EQ(with("depth-step", {"2.5mm"}).sweep.depth_step, 0.0025);
  EXPECT_EQ(with("memory", {"2GiB"}).memory_bytes, std::uint64_t{2} << 30);
  EXPECT_EQ(with("tile", {"17", "5"}).tile_height, 5);
}

TEST(RunOptions, ASwitchThatIsOnIsTurnedOffByNo) {
  EXPECT_EQ(option_named("confirm").given_name(), "no-confirm");
  EXPECT_FALSE(with("confirm", {}).confirm);
  EXPECT_EQ(option_named("fill-holes").given_name(), "fill-holes");
  EXPECT_TRUE(with("fill-holes", {}).fusion.fill_holes);
  EXPECT_EQ(with("no-slant", {}).sweep.window_model, WindowModel::kPlane);
}

TEST(RunOptions, WhatIsOutOfRangeIsNamedWithTheRange) {
  const auto expect_refused = [](const RunOptions& options, const std::string& message) {
    const auto checked = options.check();
    ASSERT_FALSE(checked) << message;
    EXPECT_EQ(checked.error().kind, ErrorKind::kUsage);
    EXPECT_EQ(checked.error().message, message);
  };
  RunOptions few;
  few.views.neighbor_count = 1;
  expect_refused(few, "option neighbors 1: give 2 to 32");
  RunOptions even;
  even.sweep.window = 4;
  expect_refused(even, "option window 4: give 3 to 15, odd");
  RunOptions votes;
  votes.sweep.min_votes = 5;
  expect_refused(votes, "option min-votes 5: can't exceed option neighbors 4");
  for (const float bad : {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    RunOptions confidence;
    confidence.min_confidence = bad;
    const auto checked = confidence.check();
    ASSERT_FALSE(checked);
    EXPECT_TRUE(checked.error().message.starts_with("option min-confidence ")) << checked.error().message;
  }
}

TEST(RunOptions, NegativeCountsAreRefused) {
  for (const RunOption& option : run_option_table()) {
    if (option.least_words != 1 || option.values.find(" or more") == std::string::npos) continue;
    RunOptions options;
    EXPECT_FALSE(option.parse(options, {"-1"})) << option.name;
    EXPECT_FALSE(option.parse(options, {"1x"})) << option.name;
  }
}

TEST(RunOptions, JsonHoldsWhatChangesAStage) {
  RunOptions options;
  options.sweep.threshold = 0.7F;
  const std::string depth = options_json(options, RunStage::kScene, RunStage::kDepth);
  EXPECT_NE(depth.find("\"threshold\": 0.7"), std::string::npos) << depth;
  EXPECT_EQ(depth.find("signed_distance"), std::string::npos) << depth;
  EXPECT_EQ(depth.find("\"device\""), std::string::npos) << depth;
  const std::string fusion = options_json(options, RunStage::kConfirm, RunStage::kClean);
  for (const char* name : {"signed_distance", "fill_holes", "confirm", "min_confidence", "max_slope"})
    EXPECT_NE(fusion.find(fmt::format("\"{}\"", name)), std::string::npos) << fusion;
  EXPECT_NE(fusion.find("\"confidence\",\n"), std::string::npos) << "a list: " << fusion;
}

TEST(RunOptions, TheTableOfTheDocsIsThis) {
  const std::string page = (source_folder() / "docs/options.md").string();
  const std::string expected =
      "# Options of a run\n\nWhat `quorum reconstruct`, `photos`, `depth`, `fuse` and `bench` take, each the options "
      "of "
      "its stages. Made from the\ntable in `engine/pipeline/run_options.cc`; a test holds both together.\n" +
      run_options_markdown();
  if (std::getenv("QUORUM_WRITE_DOCS") != nullptr) write_file(page, expected).value();
  const auto text = read_file(page);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, expected) << "run this test once with QUORUM_WRITE_DOCS=1";
}

}  // namespace
}  // namespace quorum
