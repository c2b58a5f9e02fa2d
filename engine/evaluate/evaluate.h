// Accuracy and completeness of a reconstruction against a known surface, as Seitz et al. 2006 measure them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

struct EvaluateOptions {
  double share = 0.9;          ///< accuracy: the distance that holds this share of the reconstruction, 0..1
  double threshold = 0.00125;  ///< completeness: share of the truth within this distance, scene units
  std::vector<double> distances = {0.00025, 0.0005, 0.00125};  ///< precision, recall and F at these, scene units
  double cap = 0.025;  ///< the mean counts distances up to this, scene units; what flies off counts the same
  std::uint64_t samples = 400000;  ///< points taken from each surface, spread by area
  std::uint64_t seed = 1;
  int seen_by = 3;            ///< with a scene: the truth counts where this many of its views see it; 0 = all of it
  double hidden_by = 0.0002;  ///< a view does not see what lies more than this behind the truth, scene units

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

struct FScore {
  double distance = 0;   ///< scene units
  double precision = 0;  ///< share of the reconstruction within the distance of the truth
  double recall = 0;     ///< share of the truth within the distance of the reconstruction
  double f = 0;          ///< harmonic mean; 0 if both are 0
};

struct Evaluation {
  double accuracy = 0;             ///< distance that holds `share` of the reconstruction, scene units
  double median_accuracy = 0;      ///< the same for half of it
  double mean_accuracy = 0;        ///< mean distance from the reconstruction to the truth, none counted above `cap`
  double completeness = 0;         ///< share of the truth within `threshold`
  double seen_share = 1;           ///< of the truth that counts
  std::uint64_t components = 0;    ///< pieces of the reconstruction: triangles joined by vertices; points of a cloud
  std::uint64_t vertices = 0;      ///< of the reconstruction
  std::uint64_t far_vertices = 0;  ///< of them further than `threshold` from the truth
  std::vector<FScore> f_scores;
};

/// Compares mesh or cloud against mesh or cloud. Meshes are sampled by area, clouds taken point by point; distances are
/// exact to the nearest triangle (or point, for a cloud). Same result for any number of threads.
/// scene: if given, completeness and recall are those of the truth that options.seen_by of its views see; all that was
/// reconstructed counts for accuracy and precision.
/// Fails (kUsage) on options out of range, (kInput) if a side is empty or has a position that is not finite, or if no
/// truth is seen, and (kMemory, kDevice) if Embree can't build a search tree.
Expected<Evaluation> evaluate(const Mesh& reconstruction, const Mesh& truth, const EvaluateOptions& options,
                              const Scene* scene = nullptr);

/// The samples of the truth that count; see evaluate(). Fails as it does.
Expected<std::vector<Eigen::Vector3d>> sample_truth(const Mesh& truth, const EvaluateOptions& options,
                                                    const Scene* scene);

}  // namespace quorum
