// OUT/report.html: one file that shows a run and its mesh, and how sure each place of it is.
#pragma once

#include "engine/core/error.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/progress.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Writes report.html into the workspace of a run of this scene; it opens without a network. Fails (kInput) as
/// page_data does, or if the file can't be written.
Expected<void> write_report(const Scene& scene, const Workspace& workspace, const MemoryBudget& budget,
                            Progress& progress);

}  // namespace quorum
