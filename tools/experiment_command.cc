// quorum experiment: the experiments of the paper's section 4.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <optional>

#include "engine/experiment/experiment.h"
#include "engine/experiment/run_experiments.h"
#include "tools/command.h"
#include "tools/console_progress.h"
#include "tools/open_backend.h"

namespace quorum {
namespace {

struct Arguments {
  ExperimentArguments experiment;
  std::string device = "auto";
  int threads = 0;
  bool quiet = false;
};

Expected<void> run(const Arguments& arguments) {
  if (arguments.threads < 0 || arguments.threads > 1024)
    return failure(ErrorKind::kUsage, fmt::format("--threads {}: give 1 to 1024, or 0 for all", arguments.threads));
  std::optional<tbb::global_control> limit;
  if (arguments.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.threads));
  ConsoleProgress progress(arguments.quiet);
  auto backend = open_backend(arguments.device, {});
  if (!backend) return std::unexpected(backend.error());
  auto done = run_experiments(paper_catalog(), arguments.experiment, **backend, progress);
  progress.finish();
  if (done) progress.note((arguments.experiment.output / "experiments.md").string());
  return done;
}

std::string list_of_experiments() {
  std::string list = "Experiments:";
  for (const Experiment& experiment : paper_catalog().experiments)
    list += fmt::format("\n  {:<12} {}", experiment.name, experiment.question);
  return list + "\n  all          all of them";
}

}  // namespace

int experiment_command(int argc, char** argv) {
  CLI::App app("Repeat the experiments of the paper's section 4, and write a table and figures.", "experiment");
  Arguments arguments;
  app.add_option("names", arguments.experiment.names, "Which experiments; see below")->required();
  app.add_option("-o,--output", arguments.experiment.output,
                 "Folder for table, figures and runs; made if missing. What it holds already is not run again")
      ->required();
  app.add_option("--data", arguments.experiment.data,
                 "Folder that holds the data sets, each in a folder of its name (templeRing, dragonRing …) "
                 "[none: synthetic scenes alone]");
  app.add_option("--device", arguments.device, "auto, cpu, an index or a part of a name of `quorum devices`")
      ->capture_default_str();
  app.add_option("--threads", arguments.threads, "CPU threads; 0: all")->capture_default_str();
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors");
  app.footer(list_of_experiments());
  return run_command(app, argc, argv, [&] { return run(arguments); });
}

}  // namespace quorum
