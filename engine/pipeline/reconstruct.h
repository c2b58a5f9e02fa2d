// The whole run: photographs with cameras in, depth maps and a mesh out.
#pragma once

#include "engine/core/error.h"
#include "engine/depth/sweep_options.h"
#include "engine/mesh/clean.h"
#include "engine/pipeline/backend.h"
#include "engine/pipeline/progress.h"
#include "engine/pipeline/run_report.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"
#include "engine/scene/select_views.h"
#include "engine/volume/fusion_options.h"

namespace quorum {

struct ReconstructOptions {
  SelectViewsOptions views;
  SweepOptions sweep;
  FusionOptions fusion;
  CleanOptions clean;
  bool confirm = true;               ///< weigh depths by what other views' depth maps make of them, not by conf(d)
  bool automatic_confidence = true;  ///< clean.min_confidence from the mesh itself
  double mask_below = 0.0;           ///< level of the dark-background mask, 0..1; 0 = none (paper 4.6)
  std::uint64_t memory_bytes = 0;    ///< that the process may hold; 0 = automatic (MemoryBudget)

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

/// Depth maps of all views into the workspace. A view with fewer than two neighbors is noted and left out.
/// Fails (kInput) if no view has two neighbors or an image is bad, as the backend does, or kStopped.
Expected<void> compute_depth_maps(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                                  const Workspace& workspace, Progress& progress, RunReport& report);

/// The depth maps of the workspace into mesh.ply. Views without a depth map are left out.
/// Fails (kInput) if there are none or they don't fit the scene, as the backend does, or kStopped.
Expected<void> fuse_depth_maps(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                               const Workspace& workspace, Progress& progress, RunReport& report);

}  // namespace quorum
