// quorum report as a user runs it.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/test_support.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Report : public ToolTest {
 protected:
  void SetUp() override { synthesize(12, 200); }
  [[nodiscard]] std::filesystem::path result() const { return below("result"); }

  /// Takes the views from first to last, 1 to 12, out of the list of cameras.
  void remove_views(int first, int last) {
    const auto path = scene() / "temple_par.txt";
    std::istringstream lines(file_bytes(path));
    std::string kept;
    std::string line;
    for (int number = 0; std::getline(lines, line); ++number)
      if (number > 0 && (number < first || number > last)) kept += line + "\n";
    write_text(path, std::to_string(12 - (last - first + 1)) + "\n" + kept);
  }

  void reconstruct(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", result().string(), "--device",
                                          "cpu",         "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult done = quorum_program(arguments);
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }

  /// What the page shows.
  nlohmann::json report() {
    const ProgramResult done = quorum_program({"report", result().string(), "--scene", scene().string()});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const std::string page = file_bytes(result() / "report.html");
    const std::string opening = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(opening) + opening.size();
    EXPECT_TRUE(contains(page, "THREE"));
    EXPECT_FALSE(contains(page, "src=\"http"));
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin), nullptr, false);
  }
};

TEST_F(Report, NamesTheSectorThatNoPhotographSees) {
  remove_views(4, 8);
  reconstruct();
  const nlohmann::json data = report();
  ASSERT_TRUE(data.is_object());
  EXPECT_EQ(data["views"].size(), 7U);
  EXPECT_TRUE(data["views"][0]["photograph"].get<std::string>().starts_with("data:image/jpeg;base64,"));
  EXPECT_GT(data["mesh"]["all_triangles"], 1000);
  bool is_named = false;
  for (const auto& hole : data["holes"]) {
    const auto nearest = hole["nearest"].get<std::set<std::string>>();
    if (nearest == std::set<std::string>{"temple0003", "temple0009"} && hole["seen_by"] < 3) is_named = true;
  }
  EXPECT_TRUE(is_named) << data["holes"].dump();
}

TEST_F(Report, WhereTheRunsOwnBoxCutsTheSurfaceNothingIsMissing) {
  // The lower half of the temple: the box cuts it at y = 0.08.
  reconstruct({"--bounds", "-0.05", "0", "-0.0375", "0.05", "0.08", "0.0375"});
  const nlohmann::json data = report();
  ASSERT_TRUE(data.is_object());
  int at_the_cut = 0;
  for (const auto& hole : data["holes"])
    for (std::size_t y = 1; y < hole["line"].size(); y += 3) at_the_cut += hole["line"][y] > 0.079 ? 1 : 0;
  EXPECT_LT(at_the_cut, 20);
}

TEST_F(Report, ADamagedRecordIsNoFinishedRun) {
  std::filesystem::create_directory(result());
  for (const char* bad : {"{", "[]", R"({"scene": 3})", R"({"volume": "x"})"}) {
    write_text(result() / "run.json", bad);
    expect_failure(quorum_program({"report", result().string(), "--scene", scene().string()}), 3, {"run.json"});
  }
}

TEST_F(Report, WithoutAFinishedRunItSaysSo) {
  expect_failure(quorum_program({"report", result().string(), "--scene", scene().string()}), 3,
                 {"run.json", "quorum reconstruct"});
}

}  // namespace
}  // namespace quorum
