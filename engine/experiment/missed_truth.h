// Why a reconstruction lacks what views see: the stage in which each piece of the true surface was lost.
#pragma once

#include <cstdint>

#include "engine/core/error.h"
#include "engine/evaluate/evaluate.h"
#include "engine/pipeline/workspace.h"

namespace quorum {

/// Samples of the truth that count, and of those further than EvaluateOptions::threshold from the mesh, by cause.
struct MissedTruth {
  std::uint64_t samples = 0;      ///< that count, see sample_truth()
  std::uint64_t never_depth = 0;  ///< no view that sees it has a depth at its pixel
  std::uint64_t wrong_depth = 0;  ///< some have, but none within the threshold of it
  std::uint64_t in_fusion = 0;    ///< a depth map has it, the surface before clean-up does not
  std::uint64_t in_clean_up = 0;  ///< that surface has it; or in_fusion, where that surface is not known

  [[nodiscard]] std::uint64_t missed() const { return never_depth + wrong_depth + in_fusion + in_clean_up; }
};

/// uncleaned: the surface before clean-up, or null. Views without a depth map have no depth anywhere. Fails as
/// evaluate() does, and (kInput) if no view of the scene has a depth map, or a file does not fit its view.
Expected<MissedTruth> find_missed_truth(const Scene& scene, const Workspace& workspace, const Mesh& mesh,
                                        const Mesh* uncleaned, const Mesh& truth, const EvaluateOptions& options);

}  // namespace quorum
