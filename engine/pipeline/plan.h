// What a run will cost, before it begins: sizes from cameras and box, times from a few views that are swept small.
#pragma once

#include <cstdint>

#include "engine/pipeline/run_options.h"
#include "engine/scene/scene.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

struct Plan {
  int views = 0;             ///< that get a depth map
  int left_out = 0;          ///< that have too few neighbors
  std::uint64_t pixels = 0;  ///< of the views
  double swept_share = 0.0;  ///< of them, whose rays meet the box
  double samples = 0.0;      ///< depth samples of a swept pixel, mean
  VoxelGrid grid;            ///< of the volume
  std::uint64_t blocks = 0;  ///< near the surface
  std::uint64_t triangles = 0;
  std::uint64_t least_memory = 0;  ///< bytes; the volume is filled slab by slab then
  std::uint64_t full_memory = 0;   ///< bytes; the volume is filled at once
  std::uint64_t disk = 0;          ///< bytes
  // CPU seconds.
  double depth_seconds = 0.0;
  double half_seconds = 0.0;  ///< of them: images of half the size, where full size gives no depth
  double confirm_seconds = 0.0;
  double collect_seconds = 0.0;  ///< each shard of the fusion spends all of it
  double merge_seconds = 0.0;
  double join_seconds = 0.0;  ///< by one process

  [[nodiscard]] double cpu_seconds() const {
    return depth_seconds + confirm_seconds + collect_seconds + merge_seconds + join_seconds;
  }
  /// Seconds of so many shards at once, each with so many threads.
  [[nodiscard]] double seconds(int shards, int threads) const;
  /// The fewest shards that take no more seconds; 0 if none do.
  [[nodiscard]] int shards(double seconds, int threads) const;
};

/// On the CPU. Reads and sweeps three photographs, made small. Fails as select_views, make_voxel_grid and the sweep do.
Expected<Plan> make_plan(const Scene& scene, const RunOptions& options);

}  // namespace quorum
