// The second half of a run: depth maps of many views to one surface, slab by slab where the volume is larger than the
// memory.
#pragma once

#include <vector>

#include "engine/mesh/marching_cubes.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// What depth maps say of the volume, before triangles are made.
struct MeasuredVolume {
  MeasuredSurface surface;
  std::vector<BlockBits> empty;           ///< voxels that views looked through, of all blocks of the grid; if holes are
                                          ///< filled
  std::size_t views_with_background = 0;  ///< around the object, of those that looked
};

/// The first step of fuse_views. A shard measures its run of the blocks that are near a surface, and looks through the
/// volume from its views. Fails as fuse_views.
Expected<MeasuredVolume> measure_volume(Run& run, const std::vector<int>& views);
/// The second one. volume: of all blocks. Fails (kMemory).
Expected<Mesh> extract_mesh(Run& run, const std::vector<int>& views, MeasuredVolume volume);

/// The surface that the views agree on, before cleaning; the same mesh for any budget. views: that have a depth map in
/// the workspace, and its certainty, if depths are confirmed. If holes are filled, they are, and nothing of less than
/// least_confidence() is left but what was filled in. Fails (kInput) if a file does not fit its view, (kUsage) as
/// make_voxel_grid, (kMemory) if the budget does not hold the smallest slab or the mesh, as the backend does, or
/// (kStopped).
Expected<Mesh> fuse_views(Run& run, const std::vector<int>& views);

/// The confidence that a vertex needs to stay: that of the options, or one chosen from all vertices. The report tells
/// it.
float least_confidence(Run& run, const std::vector<Vertex>& vertices);

}  // namespace quorum
