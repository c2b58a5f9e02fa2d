// Runs of the whole method with given settings, measured and kept.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/experiment/experiment.h"
#include "engine/experiment/run_record.h"
#include "engine/pipeline/progress.h"

namespace quorum {

/// Makes runs below one folder:
///   runs/ID.json, runs/ID/PICTURE.png   the record and the pictures of a run, kept
///   work/                               depth maps and mesh of the last run
/// A run that was made before, in this process or another, is read instead; consecutive runs that differ in fusion
/// alone share their depth maps.
class RunMaker {
 public:
  /// folder: made if missing. scenes: those that settings name, which lie on the shelf.
  RunMaker(std::filesystem::path folder, const std::vector<ExperimentScene>& scenes, SceneShelf shelf, Backend& backend,
           Progress& progress)
      : folder_(std::move(folder)), scenes_(scenes), shelf_(std::move(shelf)), backend_(backend), progress_(progress) {}

  /// The record of a run, from its file or made now. Fails as the pipeline does, or kStopped.
  Expected<RunRecord> run(const RunSettings& settings);
  /// True if the last run() made its run now.
  [[nodiscard]] bool was_made() const { return was_made_; }
  /// Where a picture of that run is; it may be absent.
  [[nodiscard]] std::filesystem::path picture_path(const RunRecord& record, Picture picture) const;

 private:
  Expected<const OpenScene*> open(const std::string& scene);
  Expected<void> make(const OpenScene& scene, const RunSettings& settings, RunRecord& record);
  static Expected<void> provide_depth_maps(Run run, const OpenScene& scene, RunRecord& record);

  std::filesystem::path folder_;
  const std::vector<ExperimentScene>& scenes_;
  SceneShelf shelf_;
  std::unique_ptr<OpenScene> open_;  ///< the last scene
  Backend& backend_;
  Progress& progress_;
  bool was_made_ = false;
};

}  // namespace quorum
