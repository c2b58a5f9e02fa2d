// What a run of an experiment did, and the file that keeps it.
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/error.h"
#include "engine/experiment/measures.h"

namespace quorum {

/// What a run did, whatever experiment it belongs to.
struct RunRecord {
  std::string scene;
  std::string identity;  ///< JSON: all that the result depends on
  std::string device;
  double wall_seconds = 0.0;  ///< the measuring is not counted
  double cpu_seconds = 0.0;
  double depth_cpu_seconds = 0.0;  ///< of the depth maps' share
  std::uint64_t peak_memory_bytes = 0;
  double voxel_size = 0.0;      ///< scene units
  double min_confidence = 0.0;  ///< that a vertex needed
  DepthMeasures depth;
  MeshScore mesh;
  std::string problem;  ///< why there is no surface, or empty
};

/// The record as indented JSON text, and back. Reading fails (kInput) on text that is no record.
std::string record_json(const RunRecord& record);
Expected<RunRecord> read_record(const std::string& text);

}  // namespace quorum
