// quorum bench: what each stage costs on this machine, beside the least that its work takes.
#include <fmt/format.h>

#include "engine/bench/bench_text.h"
#include "engine/io/file.h"
#include "engine/io/scratch_folder.h"
#include "engine/pipeline/synthesize.h"
#include "tools/messages.h"
#include "tools/run_pipeline.h"

namespace quorum {
namespace {

struct BenchArguments {
  RunArguments run;
  std::filesystem::path json;
  std::vector<std::string> compare;  ///< an old report, and perhaps a new one
};

Expected<BenchReport> bench_scene(RunArguments& arguments) {
  QUORUM_ASSIGN(auto scratch, ScratchFolder::make());
  std::string name = arguments.scene.string();
  if (arguments.scene.empty()) {
    name = "synthetic temple";
    arguments.scene = scratch.path() / "scene";
    QUORUM_TRY(synthesize_temple(arguments.scene, TempleOptions{}));
  }
  arguments.output = scratch.path() / "result";
  arguments.command = "bench";
  BenchReport bench;
  QUORUM_TRY(with_run(arguments, {}, [&](Run& run) -> Expected<void> {
    QUORUM_ASSIGN(bench, bench_run(run, name));
    return {};
  }));
  return bench;
}

Expected<void> run_bench(BenchArguments& arguments) {
  std::vector<BenchReport> reports;
  for (const std::string& path : arguments.compare) {
    QUORUM_ASSIGN(auto report, read_bench(path));
    reports.push_back(std::move(report));
  }
  if (reports.size() < 2) {
    QUORUM_ASSIGN(auto report, bench_scene(arguments.run));
    if (!arguments.json.empty()) QUORUM_TRY(write_file(arguments.json, bench_json(report)));
    write_result(bench_table(report));
    if (!reports.empty()) write_result("\n");
    reports.push_back(std::move(report));
  }
  if (!arguments.compare.empty()) write_result(compare_table(reports[0], reports[1]));
  return {};
}

}  // namespace

int bench_command(int argc, char** argv) {
  CommandLine line("Measure what each stage costs on this machine, beside the least that its work takes.", "bench");
  BenchArguments arguments;
  line.add("scene", arguments.run.scene, "Folder with photographs and cameras [a temple, rendered for this]");
  line.add("-o,--output", arguments.json, "File for the report as JSON");
  line.add("--compare", arguments.compare,
           "A report to compare with; with a second one, nothing is run and these two are compared")
      .takes(1, 2);
  line.add_switch("--quiet", arguments.run.quiet, "Print nothing but errors");
  add_run_options(line, arguments.run.options, kAllStages);
  return run_command(line, argc, argv, [&] { return run_bench(arguments); });
}

}  // namespace quorum
