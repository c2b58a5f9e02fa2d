// The run: a scene in, depth maps and a mesh out.
#pragma once

#include <quorum/options.h>
#include <quorum/result.h>
#include <quorum/results.h>
#include <quorum/scene.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace quorum::v0 {

/// Where a run stands.
struct Progress {
  std::string_view stage;  ///< "computing depth maps"; valid during the call
  int done = 0;            ///< steps of the stage
  int steps = 0;
  double percent = 0.0;                ///< of the stage, 0 to 100
  double run_percent = 0.0;            ///< of the whole run, 0 to 100
  std::optional<double> seconds_left;  ///< of the stage; empty until it can be told
  std::optional<double> run_seconds_left;
};

/// How a run is made. The functions may be empty; they are called on the thread that called reconstruct(). What they
/// throw stops the run and comes out of reconstruct(), which throws nothing else.
struct RunSettings {
  std::filesystem::path workspace = {};  ///< where results are kept, and those of an earlier run taken up; empty: none
  bool mesh = true;                      ///< false: depth maps and their certainties alone
  bool restart = false;                  ///< make all anew, also what earlier runs made of the same
  bool report_page = false;              ///< also report.html, as `quorum report` makes it; needs the mesh
  std::function<void(const Progress&)> on_progress = {};    ///< a stage begins, or has made a step
  std::function<void(std::string_view line)> on_note = {};  ///< what the user should know
  std::function<bool()> should_stop = {};                   ///< asked before each view: true ends the run (kStopped)
};

/// Makes the depth maps of all views and the mesh; with the same options the same bytes as `quorum reconstruct`.
/// Options of the scene must be those that it was read with, if they are set at all. Fails (kUsage) if an option is
/// wrong, (kInput) if a file is bad, no view has two neighbors or the mesh is empty, (kNoDevice), (kDevice), (kMemory),
/// (kStopped). What is finished by then stays in the workspace, and the same call goes on from there.
///
/// Several runs may go on at once in different workspaces; "threads" and "memory" are meant for the whole process.
[[nodiscard]] QUORUM_API Result<Results> reconstruct(const Scene& scene, const Options& options = {},
                                                     const RunSettings& settings = {});

}  // namespace quorum::v0
