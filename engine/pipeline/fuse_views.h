// The second half of a run without its files' names: depth maps of many views to one surface, slab by slab where the
// volume is larger than the memory.
#pragma once

#include <functional>
#include <vector>

#include "engine/io/image_store.h"
#include "engine/mesh/mesh.h"
#include "engine/pipeline/backend.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/progress.h"
#include "engine/pipeline/run_report.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

/// What the fusion works with. Everything outlives the call.
struct FusionInput {
  const Scene& scene;
  const std::vector<int>& views;  ///< that have a depth map in the workspace
  const VoxelGrid& grid;
  const FusionOptions& options;
  const Workspace& workspace;
  const MemoryBudget& budget;
  Backend& backend;
  ImageStore& images;
  Progress& progress;
  RunReport& report;
  bool confirmed = false;  ///< weigh by the certainty of depths, which the workspace holds, in place of conf(d)
  /// If holes are filled (FusionOptions::fill_holes): the least confidence of what was measured, from all vertices.
  std::function<float(const std::vector<Vertex>&)> min_confidence = [](const std::vector<Vertex>&) { return 0.0F; };
};

/// The surface that the views agree on, before cleaning; the same mesh for any budget. If holes are filled, they are,
/// and nothing of less than the least confidence is left but what was filled in. Fails (kInput) if a file does
/// not fit its view, (kMemory) if the budget does not hold the smallest slab or the mesh, as the backend does, or
/// (kStopped).
Expected<Mesh> fuse_views(const FusionInput& input);

}  // namespace quorum
