// The table of all experiments, as JSON and as Markdown.
#pragma once

#include <string>
#include <vector>

#include "engine/experiment/experiment.h"
#include "engine/experiment/run_maker.h"

namespace quorum {

/// A run of an experiment with what came of it.
struct RunResult {
  std::size_t run = 0;  ///< index into Experiment::runs
  RunRecord record;
};

/// An experiment with the runs that were made; those whose data set is missing are left out.
struct ExperimentResult {
  const Experiment* experiment = nullptr;
  std::vector<RunResult> runs;
  std::vector<std::string> figures;  ///< names of the figures that were drawn
};

/// All settings and measures, indented. Lengths in scene units, times in seconds.
std::string results_json(const std::vector<ExperimentResult>& results);

/// A table for each experiment, and its figures as figures/NAME.png. Lengths in millimeters.
std::string results_markdown(const std::vector<ExperimentResult>& results);

/// A line about one run, for the console.
std::string result_line(const RunSettings& settings, const RunRecord& record);

}  // namespace quorum
