// The whole run: photographs with cameras in, depth maps and a mesh out.
#pragma once

#include "engine/core/error.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// The steps of a run. All are `quorum reconstruct`, the first is `quorum depth`, the second `quorum confirm`, both
/// others `quorum fuse`, and the last `quorum join`.
struct RunSteps {
  bool depth_maps = true;
  bool certainties = true;
  bool mesh = true;
  bool joins = false;  ///< the volume was measured by shards
};

/// Makes depth maps of all views, the mesh of these, and the files beside it that the options ask for, in the run's
/// workspace, and writes run.json. All that the options can get wrong is refused (kUsage, kInput, kMemory) before any
/// work. Fails as the stages do: (kInput) if a file is bad, no view has two neighbors, or there is no depth map;
/// (kDevice, kMemory) as the backend does; (kStopped).
///
/// A shard (RunOptions::shard) does its part of the one step that is asked for, and writes shards/STAGE-I-of-N.json in
/// place of run.json. Shards of a step may run in any order and at once, each also again; when all are done, the next
/// step may begin. The results have the bytes of one run.
Expected<void> reconstruct(Run& run, const RunSteps& steps = {});

}  // namespace quorum
