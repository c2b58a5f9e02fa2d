#include "engine/bench/bench_text.h"

#include <gtest/gtest.h>

#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

BenchReport make_report() {
  BenchReport report;
  report.version = "1.2.3";
  report.device = "a device";
  report.scene = "a scene";
  report.views = 3;
  report.width = 64;
  report.height = 48;
  report.rates = {2e9, 1e9};
  report.costs = {{"sweep_depth", "pixel · depth · neighbor", 1e6, 0.02, 4e6, 1e5, "4 operations", 0.002}};
  report.stages = {{"load_images", 0.5, 0.25}};
  report.wall_seconds = 2.0;
  report.cpu_seconds = 3.0;
  report.host_seconds = 1.5;
  report.megapixels = 0.5;
  report.bytes_written = 40 << 20;
  report.peak_memory_bytes = 100 << 20;
  return report;
}

TEST(BenchText, JsonIsReadBackAsItWas) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bench.json";
  const std::string json = bench_json(make_report());
  write_text(path, json);
  const auto read = read_bench(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(bench_json(*read), json);
}

TEST(BenchText, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bench.json";
  for (const std::string text : {"", "no JSON", "{}", R"({"version": 1})"}) {
    write_text(path, text);
    expect_bad_input(read_bench(path), {"bench.json", "quorum bench -o"});
  }
  expect_bad_input(read_bench(folder.path() / "none.json"), {"none.json"});
}

TEST(BenchText, TableTellsTheCostAndHowFarItIsFromItsLimit) {
  const std::string table = bench_table(make_report());
  EXPECT_NE(table.find("1 M          20           2    10.0"), std::string::npos) << table;
  EXPECT_NE(table.find("4 operations"), std::string::npos) << table;
  BenchReport unknown = make_report();
  unknown.rates = {};
  unknown.costs[0].limit_seconds = 0.0;
  EXPECT_NE(bench_table(unknown).find("unknown"), std::string::npos);
}

TEST(BenchText, ComparisonTellsNewOverOld) {
  BenchReport after = make_report();
  after.costs[0].seconds = 0.01;
  after.stages.push_back({"only new", 1.0, 1.0});
  after.peak_memory_bytes = 150 << 20;
  const std::string table = compare_table(make_report(), after);
  EXPECT_NE(table.find("20          10    0.500"), std::string::npos) << table;
  EXPECT_NE(table.find("100         150    1.500"), std::string::npos) << table;
  EXPECT_EQ(table.find("only new"), std::string::npos) << table;
  EXPECT_NE(table.find("3           3    1.000"), std::string::npos) << "1.5 s outside kernels: " << table;
}

TEST(BenchReport, SecondsOutsideKernelsLeaveOutThoseOfTheHostAlone) {
  RunReport report;
  report.cpu_seconds = 5.0;
  report.kernels = {{"sweep_depth", 1.0}, {"integrate", 2.0}};
  EXPECT_EQ(seconds_outside_kernels(report, true), 2.0);
  EXPECT_EQ(seconds_outside_kernels(report, false), 5.0);
  report.cpu_seconds = 1.0;  // clocks of different threads
  EXPECT_EQ(seconds_outside_kernels(report, true), 0.0);
}

TEST(BenchReport, CostsCountTheWorkOfTheRun) {
  Scene scene;
  scene.views.resize(2);
  scene.views[0].name = "a";
  scene.views[0].width = scene.views[1].width = 10;
  scene.views[0].height = scene.views[1].height = 10;
  RunOptions options;
  options.sweep.window_model = WindowModel::kPlane;
  RunReport report;
  report.views = {{"a", {"b", "c"}, 50, 500, 20}};
  report.kernels = {{"sweep_depth", 1.0}, {"integrate", 2.0}};
  report.stages = {{"marching_cubes", 1.0, 3.0}};
  report.voxel_size = 1.0;
  report.truncation = 4.0;
  report.blocks = 7;
  report.block_views = 9;
  const auto costs = bench_costs(scene, options, report, {1e9, 1e9}, {1e3, 1e9});
  const auto cost = [&](const std::string& name) { return *std::ranges::find(costs, name, &Cost::name); };
  EXPECT_EQ(cost("sweep_depth").units, 500 * 2);
  EXPECT_EQ(cost("sweep_depth").seconds, 1.0);
  EXPECT_EQ(cost("refine_depth").units, 20 * 19 * 2);
  EXPECT_EQ(cost("collect_blocks").units, 9);
  EXPECT_EQ(cost("integrate").units, 9 * 512);
  EXPECT_NEAR(cost("integrate").limit_seconds, 33e-9 * 9 * 512, 1e-12);
  EXPECT_EQ(cost("marching_cubes").units, 7);
  EXPECT_EQ(cost("marching_cubes").seconds, 3.0);
  EXPECT_NEAR(cost("marching_cubes").limit_seconds, 1024 * 7 * 1e-3, 1e-9);

  options.sweep.window_model = WindowModel::kSlanted;
  report.sweep.refine_windows = 40;
  report.sweep.refine_samples = 1000;
  const auto slanted = bench_costs(scene, options, report, {1e9, 1e9}, {1e3, 1e9});
  EXPECT_EQ(std::ranges::count(slanted, "refine_depth", &Cost::name), 0);
  const auto planes = std::ranges::find(slanted, "refine_planes", &Cost::name);
  ASSERT_NE(planes, slanted.end());
  EXPECT_EQ(planes->units, 40);
  EXPECT_EQ(planes->operations, 70 * 1000);
}

}  // namespace
}  // namespace quorum
