// Runs experiments and writes their table and figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/experiment/experiment.h"
#include "engine/pipeline/backend.h"
#include "engine/pipeline/progress.h"

namespace quorum {

struct ExperimentArguments {
  std::vector<std::string> names;  ///< of the catalog's experiments; "all" is all of them
  std::filesystem::path output;  ///< experiments.json, experiments.md, figures/, runs/, scenes/, work/; made if missing
  std::filesystem::path data;    ///< folder of the data sets; empty = synthetic scenes alone
};

/// Runs on data sets that are missing are noted and left out. A run that the output folder has already is not made
/// again, so what was interrupted goes on; the table is written after each experiment.
/// Fails (kUsage) on an unknown name, with the known ones; (kInput) if nothing can be run without missing data, naming
/// the folders; as the pipeline does; or kStopped.
Expected<void> run_experiments(const Catalog& catalog, const ExperimentArguments& arguments, Backend& backend,
                               Progress& progress);

}  // namespace quorum
