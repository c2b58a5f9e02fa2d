// run.json: what a run was asked to do, on what, and what it did.
#pragma once

#include <string>

#include "engine/pipeline/reconstruct.h"
#include "engine/pipeline/run_report.h"

namespace quorum {

/// The report as indented JSON text. Lengths are in scene units, times in seconds, memory in bytes.
std::string run_json(const Scene& scene, const ReconstructOptions& options, const RunReport& report);

}  // namespace quorum
