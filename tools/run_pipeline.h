// What the commands that run the pipeline share: their arguments, and how a run is opened.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/pipeline/reconstruct.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"

namespace quorum {

inline const std::vector<RunStage> kAllStages = {RunStage::kScene,  RunStage::kDepth, RunStage::kConfirm,
                                                 RunStage::kFusion, RunStage::kClean, RunStage::kExtras,
                                                 RunStage::kFiles,  RunStage::kNone};

struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path output;
  RunOptions options;
  std::string command;  ///< whose name the lock of the workspace tells
  bool quiet = false;
  ProgressForm progress = ProgressForm::kText;
  bool json = false;
  bool restart = false;
  bool report = false;               ///< report.html at the end
  bool takes_depth_options = false;  ///< from what lies in the workspace
  bool takes_part_options = false;   ///< those of the volume, from what shards left there

  /// How progress is told; kNone if quiet.
  [[nodiscard]] ProgressForm progress_form() const { return quiet ? ProgressForm::kNone : progress; }

  void add_scene(CLI::App& app);
  void add_output(CLI::App& app);
  void add_restart(CLI::App& app);
};

/// Reads the scene, opens the device and the workspace, which it locks, and does the work on the run; options are
/// checked before. steps: that the work takes, for the percentage that is told. Fails as these do.
Expected<void> with_run(const RunArguments& arguments, const RunSteps& steps,
                        const std::function<Expected<void>(Run&)>& work);

/// The whole run, or one step of it.
Expected<void> run_pipeline(const RunArguments& arguments, const RunSteps& steps = {});

}  // namespace quorum
