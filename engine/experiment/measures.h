// What is measured of a run: its depth maps, its mesh, and both against the truth where it is known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/evaluate/evaluate.h"
#include "engine/experiment/scenes.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// Of all depth maps of a run. A pixel takes part if its ray meets the bounds and no mask leaves it out.
struct DepthMeasures {
  int views = 0;                        ///< with a depth map
  std::uint64_t swept_pixels = 0;       ///< that take part
  std::uint64_t valid_pixels = 0;       ///< with a depth
  std::uint64_t depth_samples = 0;      ///< pixel · depth samples of the first pass
  std::uint64_t loose_pixels = 0;       ///< with a depth that forms no triangle: the outliers that fusion drops (2.2)
  std::uint64_t background_pixels = 0;  ///< with a depth, though the photograph shows dark background there (4.6)
  double roughness = 0.0;    ///< median of |second difference of depth along a row|, in footprints of a pixel
  double correlation = 0.0;  ///< mean over pixels with a depth
  double confidence = 0.0;   ///< mean over pixels with a depth
  std::optional<double> median_error = {};  ///< distance of depths from the truth, scene units
  std::optional<double> wrong_share = {};   ///< share of depths further than 1.25 mm from the truth
};

/// Of the mesh.
struct MeshScore {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::optional<Evaluation> evaluation = {};  ///< where the truth is known and the mesh is not empty
};

/// Measures the depth maps in the workspace. report: of the run that made them. Fails as reading them does, and
/// (kStopped) before the next view if progress asks for it.
Expected<DepthMeasures> measure_depth_maps(const OpenScene& scene, const RunOptions& options,
                                           const Workspace& workspace, const RunReport& report,
                                           const Progress& progress);

/// Compares the mesh with the scene's truth. Fails as evaluate() does.
Expected<MeshScore> score_mesh(const OpenScene& scene, const Mesh& mesh);

}  // namespace quorum
