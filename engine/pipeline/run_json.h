// run.json: what a run was asked to do, on what, and what it did.
#pragma once

#include <string>

#include "engine/pipeline/reconstruct.h"
#include "engine/pipeline/run_report.h"

namespace quorum {

/// The options as indented JSON text, each under its name on the command line with _ for -. Lengths are in scene units.
std::string options_json(const ReconstructOptions& options);

/// The report as indented JSON text. Lengths are in scene units, times in seconds, memory in bytes. Stages overlap: see
/// StageReport.
std::string run_json(const Scene& scene, const ReconstructOptions& options, const RunReport& report);

}  // namespace quorum
