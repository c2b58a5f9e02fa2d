// quorum bench: what each stage costs on this machine, beside the least that its work takes.
#include <fmt/format.h>
#include <stdlib.h>

#include "engine/bench/bench_text.h"
#include "engine/core/clock.h"
#include "engine/core/host_rates.h"
#include "engine/core/memory.h"
#include "engine/core/version.h"
#include "engine/io/file.h"
#include "engine/pipeline/synthesize.h"
#include "tools/run_arguments.h"

namespace quorum {
namespace {

/// A folder of its own in the system's temporary folder, removed at the end.
class ScratchFolder {
 public:
  static Expected<ScratchFolder> make() {
    std::error_code problem;
    std::string name = (std::filesystem::temp_directory_path(problem) / "quorum-bench-XXXXXX").string();
    if (problem || ::mkdtemp(name.data()) == nullptr)
      return failure(ErrorKind::kInput, fmt::format("{}: cannot make a temporary folder; set TMPDIR", name));
    return ScratchFolder(name);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

struct BenchArguments {
  RunArguments run;
  std::filesystem::path json;
  std::vector<std::string> compare;  ///< an old report, and perhaps a new one
};

/// The whole run with its times, then the rates of the machine: these take memory that is not the run's.
Expected<BenchReport> measure(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                              const Workspace& workspace, Progress& progress, RunReport& report) {
  BenchReport bench;
  const double wall_start = wall_seconds();
  const double cpu_start = process_cpu_seconds();
  if (auto done = compute_depth_maps(scene, options, backend, workspace, progress, report); !done)
    return std::unexpected(done.error());
  if (auto done = fuse_depth_maps(scene, options, backend, workspace, progress, report); !done)
    return std::unexpected(done.error());
  bench.wall_seconds = wall_seconds() - wall_start;
  bench.cpu_seconds = process_cpu_seconds() - cpu_start;
  bench.peak_memory_bytes = peak_memory_bytes();

  progress.stage("measuring the machine", 1);
  const auto rates = backend.measure_rates();
  if (!rates) return std::unexpected(rates.error());
  const HostRates host = measure_host_rates();
  progress.step();
  bench.version = version();
  bench.device = report.device;
  bench.views = static_cast<int>(scene.views.size());
  bench.width = scene.views[0].width;
  bench.height = scene.views[0].height;
  bench.rates = *rates;
  bench.stages = report.stages;
  bench.costs = bench_costs(scene, options, report, *rates,
                            {host.operations_per_second / host.threads, host.bytes_per_second / host.threads});
  return bench;
}

Expected<BenchReport> bench_scene(RunArguments& arguments) {
  auto scratch = ScratchFolder::make();
  if (!scratch) return std::unexpected(scratch.error());
  std::string name = arguments.scene.string();
  if (arguments.scene.empty()) {
    name = "synthetic temple";
    arguments.scene = scratch->path() / "scene";
    if (auto made = synthesize_temple(arguments.scene, TempleOptions{}); !made) return std::unexpected(made.error());
  }
  arguments.output = scratch->path() / "result";
  BenchReport bench;
  auto done = run_pipeline(arguments,
                           [&](const Scene& scene, const ReconstructOptions& options, Backend& backend,
                               const Workspace& workspace, Progress& progress, RunReport& report) -> Expected<void> {
                             auto measured = measure(scene, options, backend, workspace, progress, report);
                             if (!measured) return std::unexpected(measured.error());
                             bench = std::move(*measured);
                             return {};
                           });
  if (!done) return std::unexpected(done.error());
  bench.scene = name;
  return bench;
}

Expected<void> run_bench(BenchArguments& arguments) {
  std::vector<BenchReport> reports;
  for (const std::string& path : arguments.compare) {
    auto report = read_bench(path);
    if (!report) return std::unexpected(report.error());
    reports.push_back(std::move(*report));
  }
  if (reports.size() < 2) {
    auto report = bench_scene(arguments.run);
    if (!report) return std::unexpected(report.error());
    if (!arguments.json.empty())
      if (auto written = write_file(arguments.json, bench_json(*report)); !written) return written;
    fmt::print("{}", bench_table(*report));
    if (!reports.empty()) fmt::print("\n");
    reports.push_back(std::move(*report));
  }
  if (!arguments.compare.empty()) fmt::print("{}", compare_table(reports[0], reports[1]));
  return {};
}

}  // namespace

int bench_command(int argc, char** argv) {
  CLI::App app("Measure what each stage costs on this machine, beside the least that its work takes.", "bench");
  BenchArguments arguments;
  app.add_option("scene", arguments.run.scene, "Folder with photographs and cameras [a temple, rendered for this]");
  app.add_option("-o,--output", arguments.json, "File for the report as JSON");
  app.add_option("--compare", arguments.compare,
                 "A report to compare with; with a second one, nothing is run and these two are compared")
      ->expected(1, 2);
  arguments.run.add_depth_options(app);
  arguments.run.add_fusion_options(app);
  arguments.run.add_device_options(app);
  return run_command(app, argc, argv, [&] { return run_bench(arguments); });
}

}  // namespace quorum
