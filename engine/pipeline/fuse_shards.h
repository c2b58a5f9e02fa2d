// The second half of a run in shards: each measures its part of the volume, and `quorum join` makes the mesh of all.
#pragma once

#include "engine/pipeline/fuse_views.h"

namespace quorum {

/// Measures the part of the run's shard and writes it into the workspace, unless it is there and was made of the same.
/// views: as in fuse_views. Fails as that does, and (kInput) if a depth map or certainty is missing.
Expected<void> fuse_shard(Run& run, const std::vector<int>& views);

/// The surface of all shards' parts: the bytes of fuse_views. Holds the surface and one part beside it. Fails (kInput),
/// naming it, if a part is missing or was made of other depth maps or options, and (kMemory).
Expected<Mesh> join_shards(Run& run, const std::vector<int>& views);

/// Takes the options of certainties and volume from the first part in the workspace; leaves them if there is none.
Expected<void> take_part_options(RunOptions& options, const Workspace& workspace);

}  // namespace quorum
