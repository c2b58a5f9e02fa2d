// quorum experiment: the experiments of the paper's section 4.
#include <fmt/format.h>

#include "engine/experiment/experiment.h"
#include "engine/experiment/run_experiments.h"
#include "host/run/open_backend.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"

namespace quorum {
namespace {

struct Arguments {
  ExperimentArguments experiment;
  RunOptions options;
  bool quiet = false;
};

Expected<void> run(const Arguments& arguments) {
  const ThreadLimit limit(arguments.options.threads);
  ConsoleProgress progress(arguments.quiet);
  QUORUM_ASSIGN(auto backend, open_backend(arguments.options));
  auto done = run_experiments(paper_catalog(), arguments.experiment, *backend, progress);
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
  CommandLine line("Repeat the experiments of the paper's section 4, and write a table and figures.", "experiment");
  Arguments arguments;
  line.add("names", arguments.experiment.names, "Which experiments; see below").required();
  line.add("-o,--output", arguments.experiment.output,
           "Folder for table, figures and runs; made if missing. What it holds already is not run again")
      .required();
  line.add("--data", arguments.experiment.data,
           "Folder that holds the data sets, each in a folder of its name (templeRing, dragonRing …) "
           "[none: synthetic scenes alone]");
  add_named_options(line, arguments.options, {"device", "threads"});
  line.add_switch("--quiet", arguments.quiet, "Print nothing but errors");
  line.add_footer(list_of_experiments());
  return run_command(line, argc, argv, [&] { return run(arguments); });
}

}  // namespace quorum
