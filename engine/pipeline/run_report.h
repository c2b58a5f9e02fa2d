// What a run did, for run.json.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/pipeline/backend.h"

namespace quorum {

/// Wall and CPU seconds of one stage. Stages overlap: files are read and written beside the computation, on threads of
/// their own. The time of these is theirs alone, and the CPU time of the other stages is without it, so CPU seconds add
/// up to those of the run; wall seconds add up to more.
struct StageReport {
  std::string name;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
};

struct ViewReport {
  std::string name;
  std::vector<std::string> neighbors;
  std::uint64_t swept_pixels = 0;   ///< pixels whose ray meets the bounds and that no mask leaves out
  std::uint64_t depth_samples = 0;  ///< pixel · depth samples of the first pass
  std::uint64_t valid_pixels = 0;   ///< pixels with a depth
};

struct RunReport {
  std::string device;
  std::vector<StageReport> stages;
  double wall_seconds = 0.0;            ///< of the whole run
  double cpu_seconds = 0.0;             ///< of the whole run, all threads
  std::uint64_t peak_memory_bytes = 0;  ///< of the process, so far
  std::vector<StageTime> kernels;
  SweepCounts sweep;
  DeviceWork device_work;
  std::vector<ViewReport> views;  ///< whose depth map this run made
  int kept_depth_maps = 0;        ///< that earlier runs made of the same
  int kept_certainties = 0;
  std::uint64_t compared_depths = 0;   ///< of the views whose certainty this run made
  std::uint64_t confirmed_depths = 0;  ///< those of them that another view's depths confirm
  double voxel_size = 0.0;             ///< scene units
  double truncation = 0.0;             ///< scene units
  std::uint64_t memory_budget_bytes = 0;
  std::uint64_t estimated_memory_bytes = 0;  ///< that the process would hold at most (memory_estimates.h)
  std::uint64_t blocks = 0;
  int slabs = 0;                          ///< in which the volume was filled
  std::uint64_t block_views = 0;          ///< blocks near a view's surface, summed over the views
  float min_confidence = 0.0F;            ///< that a vertex needed to stay
  std::uint64_t extracted_triangles = 0;  ///< before cleaning
  std::uint64_t vertices = 0;
  std::uint64_t filled_vertices = 0;  ///< of these, where nothing was measured
  std::uint64_t triangles = 0;
  std::uint64_t pieces = 0;  ///< of triangles that share vertices
};

/// Adds to the stage of that name, or as a new one.
void add_stage(RunReport& report, const StageReport& time);

/// Measures the stage from its making to its end, and adds it to the report (to a stage of that name, if there is one).
/// name: null = nothing is measured.
class StageTimer {
 public:
  StageTimer(RunReport& report, const char* name);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  RunReport& report_;
  const char* name_;
  double wall_start_;
  double cpu_start_;
};

}  // namespace quorum
