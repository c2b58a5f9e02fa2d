// Between the halves of a run: the certainty of all depths, from what the depth maps say of each other.
#pragma once

#include "engine/pipeline/run.h"

namespace quorum {

/// Writes the certainty of each of the views, which have a depth map in the workspace, or, where depths are not to be
/// confirmed, removes what an earlier run left of it. A view is compared with the kConfirmingViews that select_views
/// names first, those without depth map left out; what was made of the same before is kept. Only depths are read, so
/// the result does not depend on the order. Holds the depths of a view and of its others, and the next view's. Fails
/// (kInput) if a file does not fit its view, (kMemory) if the budget does not hold this, as the backend does, or
/// (kStopped). A shard does the same for its views, and fails (kInput) if one of those that it needs has no depth map
/// yet.
Expected<void> confirm_views(Run& run, const std::vector<int>& views);

/// Fails (kInput), naming the first, unless all views of the scene that have neighbors have a depth map, and each of
/// the views the certainty that confirm_views would give it. For shards, which leave it as it is.
Expected<void> check_certainties(const Run& run, const std::vector<int>& views);

}  // namespace quorum
