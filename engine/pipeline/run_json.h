// run.json: what a run was asked to do, on what, and what it did.
#pragma once

#include <string>

#include "engine/pipeline/run.h"

namespace quorum {

/// The options that change the result of a stage from first to last, as indented JSON text, each under its name with _
/// for -; those that were not given are left out. Lengths are in scene units.
std::string options_json(const RunOptions& options, RunStage first, RunStage last);

/// Takes the options of these stages from such a text; others stay. Fails (kUsage) if a value is none of its option.
Expected<void> take_options(RunOptions& options, const std::string& json, RunStage first, RunStage last);

/// The report as indented JSON text. Lengths are in scene units, times in seconds, memory in bytes. Stages overlap: see
/// StageReport.
std::string run_json(const Run& run);

}  // namespace quorum
