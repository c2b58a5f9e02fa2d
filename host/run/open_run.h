// A run as a user asks for it: the device opened, the workspace locked, and what helps told at its end. The command
// line and the library make their runs here.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/pipeline/progress_meter.h"
#include "engine/pipeline/reconstruct.h"

namespace quorum {

/// What is asked for beside the scene.
struct RunRequest {
  std::filesystem::path output;  ///< the workspace
  RunOptions options;
  std::string command;               ///< whose name the lock of the workspace tells
  bool restart = false;              ///< make all anew, also what earlier runs made of the same
  bool report = false;               ///< report.html at the end
  bool takes_depth_options = false;  ///< from what lies in the workspace
  bool takes_part_options = false;   ///< those of the volume, from what shards left there
};

/// The stages that these steps take, and their share of the time.
std::vector<StageWeight> expected_stages(const RunSteps& steps, bool is_shard);

/// Opens the device and the workspace, which it locks, and does the work on the run of a scene; options are checked
/// before. Notes of the scene, the device and a summary go to progress. steps: that the work takes. Fails as these do.
Expected<void> with_run(const Scene& scene, const RunRequest& request, Progress& progress, const RunSteps& steps,
                        const std::function<Expected<void>(Run&)>& work);

/// Does the steps, and writes report.html if it was asked for. Fails as reconstruct and write_report do, and (kInput)
/// if the mesh is empty.
Expected<void> make_results(Run& run, const RunRequest& request, const RunSteps& steps);

}  // namespace quorum
