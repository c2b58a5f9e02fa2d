// What the commands that run the pipeline share: their arguments, and how a run is opened.
#pragma once

#include <filesystem>
#include <functional>

#include "host/run/open_run.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"

namespace quorum {

inline const std::vector<RunStage> kAllStages = {RunStage::kScene,  RunStage::kDepth, RunStage::kConfirm,
                                                 RunStage::kFusion, RunStage::kClean, RunStage::kExtras,
                                                 RunStage::kFiles,  RunStage::kNone};

struct RunArguments : RunRequest {
  std::filesystem::path scene;
  bool quiet = false;
  ProgressForm progress = ProgressForm::kText;
  bool json = false;

  /// How progress is told; kNone if quiet.
  [[nodiscard]] ProgressForm progress_form() const { return quiet ? ProgressForm::kNone : progress; }

  void add_scene(CommandLine& line);
  void add_output(CommandLine& line);
  void add_restart(CommandLine& line);
};

/// Reads the scene and does the work on its run (host/run/open_run.h), with progress on the console; options are
/// checked before. Fails as these do.
Expected<void> with_run(const RunArguments& arguments, const RunSteps& steps,
                        const std::function<Expected<void>(Run&)>& work);

/// The whole run, or one step of it; run.json on standard output if asked for.
Expected<void> run_pipeline(const RunArguments& arguments, const RunSteps& steps = {});

}  // namespace quorum
