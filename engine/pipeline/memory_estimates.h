// What the stages of a run hold at most: all estimates, a line an item, under the name of what takes it. A test holds
// them against what runs hold (tests/tools/memory_test.cc).
#pragma once

#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "engine/pipeline/backend.h"
#include "engine/pipeline/run_options.h"
#include "engine/scene/scene.h"

namespace quorum {

struct MemoryItem {
  std::string_view what;  ///< the function or member that takes it
  std::uint64_t bytes = 0;
};

/// Beside what the process holds before.
struct MemoryEstimate {
  std::vector<MemoryItem> items;

  [[nodiscard]] std::uint64_t total() const {
    return std::accumulate(items.begin(), items.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const MemoryItem& item) { return sum + item.bytes; });
  }
};

/// How large the surface will be, from cameras and box alone: on scenes with a known result between two thirds and 1.5
/// times what it was (docs/cluster.md).
struct SurfaceEstimate {
  std::uint64_t blocks = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};
SurfaceEstimate estimate_surface(const Scene& scene, const VoxelGrid& grid);

/// What a whole run needs at least, stage after stage, beside what the process holds: for advice, since the surface is
/// an estimate.
std::uint64_t least_run_bytes(const Scene& scene, const RunOptions& options, const Backend& backend,
                              const VoxelGrid& grid);

/// The depth map of a view, with the next one's photographs, read meanwhile, and the last one's maps, written
/// meanwhile.
MemoryEstimate depth_map_memory(const Scene& scene, const RunOptions& options, const Backend& backend);

/// What one view more in flight takes: its photographs, read further ahead, and its maps, while they are written.
MemoryEstimate depth_map_in_flight_memory(const Scene& scene, const RunOptions& options, const Backend& backend);

/// Views whose depths and certainties are kept while others are compared with them.
constexpr std::uint64_t kRecentViews = 12;

/// The certainty of a view. views: that have a depth map, here and below.
MemoryEstimate confirm_memory(const Scene& scene, const std::vector<int>& views, const Backend& backend);

/// What one view more in flight takes.
MemoryEstimate confirm_in_flight_memory(const Scene& scene, const std::vector<int>& views, const Backend& backend);

/// A view that is merged into the volume, and the next one.
MemoryEstimate merge_memory(const Scene& scene, const std::vector<int>& views, const VoxelGrid& grid,
                            const Backend& backend);
/// What one view more in flight takes.
MemoryEstimate merge_in_flight_memory(const Scene& scene, const std::vector<int>& views);

/// A bit for each voxel of the grid, so many times, if holes are filled.
MemoryEstimate empty_space_memory(const VoxelGrid& grid, const FusionOptions& options, int copies);

/// What a block of a slab takes beside its voxels, bytes.
std::uint64_t block_surface_bytes(const FusionOptions& options);

/// The mesh while it is extracted and cleaned.
MemoryEstimate mesh_memory(std::uint64_t vertices, std::uint64_t blocks);
/// The same of a surface whose holes are filled: while triangles are made, and while filled vertices settle.
MemoryEstimate filled_surface_memory(std::uint64_t vertices, std::uint64_t blocks);
MemoryEstimate settling_memory(std::uint64_t vertices);

/// The points that a view begins. points: of the cloud so far; room: for how many it has memory.
MemoryEstimate cloud_memory(const Scene& scene, int reference, const std::vector<int>& neighbors, std::uint64_t points,
                            std::uint64_t room);
/// A cloud while it is written.
MemoryEstimate cloud_file_memory(std::uint64_t points);

/// COLMAP's workspace. neighbor_count: of each view with a depth map, by its index.
MemoryEstimate colmap_memory(const Scene& scene, const std::vector<int>& views,
                             const std::vector<std::size_t>& neighbor_count);

}  // namespace quorum
