#include "engine/experiment/run_experiments.h"

#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "tests/engine/experiment/tiny_catalog.h"

namespace quorum {
namespace {

/// Two experiments; the second is of the absent set alone.
Catalog tiny_catalog() {
  Catalog catalog{tiny_scenes(), {}};
  RunSettings seven = tiny_run("7 x 7");
  seven.options.sweep.window = 7;
  RunSettings absent = tiny_run("absent");
  absent.scene = "absentSet";
  RunSettings two = tiny_run("two views");
  two.first_views = 2;
  catalog.experiments = {{"windows",
                          "Which window",
                          {tiny_run("5 x 5"), seven, absent, two},
                          {{"both", 2, {{0, Picture::kDepth, "5 x 5"}, {1, Picture::kDepth, "7 x 7"}}},
                           {"with-absent", 2, {{0, Picture::kMesh, "5 x 5"}, {2, Picture::kMesh, "absent"}}}}},
                         {"elsewhere", "What others do", {absent, absent}, {}}};
  return catalog;
}

class RunExperiments : public testing::Test {
 protected:
  Expected<void> run(const std::vector<std::string>& names, const std::filesystem::path& data = {}) {
    return run_experiments(tiny_catalog(), {names, out_, data}, backend_, progress_);
  }

  TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "out";
  CpuBackend backend_;
  NotedProgress progress_;
};

TEST_F(RunExperiments, WriteTheirTableAndFigures) {
  const auto done = run({"windows"});
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(progress_.count("1 of 4 runs are left out, they need the data sets absentSet"), 1);
  EXPECT_EQ(progress_.count("tiny, 7 x 7: coverage"), 1);
  EXPECT_EQ(progress_.count("tiny, two views: no surface"), 1);

  const auto json = nlohmann::json::parse(read_file(out_ / "experiments.json").value(), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  ASSERT_EQ(json["experiments"].size(), 1U);
  const auto& experiment = json["experiments"][0];
  EXPECT_EQ(experiment["name"], "windows");
  ASSERT_EQ(experiment["runs"].size(), 3U);
  EXPECT_EQ(experiment["runs"][1]["label"], "7 x 7");
  EXPECT_EQ(experiment["runs"][1]["options"]["window"], 7);
  EXPECT_GT(experiment["runs"][1]["mesh"]["vertices"].get<int>(), 100);
  EXPECT_EQ(experiment["figures"], nlohmann::json::array({"both"}));

  const std::string table = read_file(out_ / "experiments.md").value();
  EXPECT_NE(table.find("| tiny | 7 x 7 | 8 |"), std::string::npos) << table;
  EXPECT_NE(table.find("figures/both.png"), std::string::npos);
  const auto figure = read_image(out_ / "figures" / "both.png");
  ASSERT_TRUE(figure) << figure.error().message;
  EXPECT_GT(figure->width, 2 * 20);
  EXPECT_FALSE(std::filesystem::exists(out_ / "figures" / "with-absent.png"));
}

TEST_F(RunExperiments, GoOnWhereTheyWereInterrupted) {
  progress_.stop_after = 2;  // the note on absent data, and the first run's
  const auto stopped = run({"all"});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::kStopped);
  progress_.stop_after = 0;
  progress_.notes.clear();
  ASSERT_TRUE(run({"all"}));
  EXPECT_EQ(progress_.count("kept: tiny, 5 x 5"), 1);
  EXPECT_EQ(progress_.count("kept: "), 1);
  progress_.notes.clear();
  ASSERT_TRUE(run({"all"}));
  EXPECT_EQ(progress_.count("kept: "), 3);
}

TEST_F(RunExperiments, UnknownNamesAreRefusedWithTheKnownOnes) {
  const auto refused = run({"windows", "doors"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(refused.error().message, "doors: no such experiment; there are all, windows, elsewhere");
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(RunExperiments, WithoutAnyDataTheMissingSetsAreNamed) {
  const auto refused = run({"elsewhere"}, "/no/where");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  EXPECT_NE(refused.error().message.find("absentSet: not in /no/where"), std::string::npos) << refused.error().message;
  EXPECT_NE(run({"elsewhere"}).error().message.find("--data"), std::string::npos);
}

}  // namespace
}  // namespace quorum
