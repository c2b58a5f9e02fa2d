// Between the halves of a run: the certainty of all depths, from what the depth maps say of each other.
#pragma once

#include "engine/pipeline/reconstruct.h"

namespace quorum {

/// Writes the certainty of each of the views, which have a depth map in the workspace. A view is compared with the
/// kConfirmingViews that select_views names first, those without depth map left out. Only depths are read, so the
/// result does not depend on the order. Holds the depths of a view and of its others, and the next view's. Fails
/// (kInput) if a file does not fit its view, (kMemory) if the budget does not hold this, as the backend does, or
/// (kStopped).
Expected<void> confirm_views(const Scene& scene, const std::vector<int>& views, const ReconstructOptions& options,
                             Backend& backend, const Workspace& workspace, Progress& progress, RunReport& report);

}  // namespace quorum
