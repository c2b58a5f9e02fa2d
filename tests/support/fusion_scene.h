// The sphere with exact depth maps in a workspace: an input for the second half of a run.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/pipeline/fuse_views.h"
#include "tests/support/test_support.h"

namespace quorum {

/// Eight cameras around the sphere, and one above and one below; their photographs and depth maps as files.
class FusionScene {
 public:
  /// hole: a piece of the sphere, around hole_center(), has no depth in any map.
  explicit FusionScene(bool hole = false);

  /// The surface, and what was done for it.
  Expected<Mesh> fuse(Backend& backend, RunReport& report, std::uint64_t memory_bytes = 0) const;
  /// The same with filled holes. mask_below: as ImageStore takes it.
  Expected<Mesh> fill(Backend& backend, RunReport& report, double mask_below, double voxel_size = kVoxelSize) const;

  static constexpr double kVoxelSize = 0.05;

  /// Gives a view a mask that leaves out one pixel.
  void mask_pixel(std::size_t view, int x, int y);

  /// Cosine of the angle between a point of the hole and its center, at least.
  static constexpr double kHoleCosine = 0.94;
  static Eigen::Vector3d hole_center() { return Eigen::Vector3d(0.6, 0.3, -0.74).normalized(); }

 private:
  [[nodiscard]] Expected<Mesh> fuse(Backend& backend, RunReport& report, const FusionOptions& options,
                                    std::uint64_t memory_bytes, double mask_below) const;

  TemporaryFolder folder_;
  Scene scene_;
};

}  // namespace quorum
