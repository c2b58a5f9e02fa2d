// Whether a run's results are what the same photographs and options give here.
#pragma once

#include <string>

#include "engine/pipeline/run.h"

namespace quorum {

/// The options of a finished run that change its results, from its run.json; others as given. What is given of the
/// scene (folders) comes before what run.json says. Fails (kInput) if there is no run.json, if it is of another version
/// of Quorum, or if it holds what is no option.
Expected<RunOptions> options_of_run(const Workspace& workspace, const RunOptions& given);

/// What two workspaces hold, stage by stage.
struct RunComparison {
  std::size_t files = 0;  ///< that were compared
  std::string stage;      ///< of the first difference: "photographs, cameras and options", "depth maps",
                          ///< "certainties" or "mesh"; empty if there is none
  std::string different;  ///< its file
};

/// Compares the files of one run with those of another of the same scene, in the order in which one follows from the
/// other. A file that is in one alone is a difference. Fails (kInput) if a file can't be read.
Expected<RunComparison> compare_runs(const Scene& scene, const Workspace& one, const Workspace& other);

/// Adds to verified.json in the workspace that this device gave the same bytes; `quorum report` shows it. Fails
/// (kInput) if it can't be written.
Expected<void> record_verified(const Workspace& workspace, std::string_view device);

}  // namespace quorum
