// The room of a run: everything that its stages work with.
#pragma once

#include <string_view>

#include "engine/pipeline/backend.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/memory_estimates.h"
#include "engine/pipeline/progress.h"
#include "engine/pipeline/run_options.h"
#include "engine/pipeline/run_report.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

/// What is referred to outlives the run.
struct Run {
  const Scene& scene;
  const RunOptions& options;
  Backend& backend;
  const Workspace& workspace;
  Progress& progress;
  MemoryBudget budget = MemoryBudget(options.memory_bytes);
  RunReport report = {};

  [[nodiscard]] const View& view(int index) const { return scene.views[static_cast<std::size_t>(index)]; }
  /// The views that have a depth map in the workspace, ascending. Fails (kInput) if there are none.
  [[nodiscard]] Expected<std::vector<int>> views_with_depth_map() const;
  /// Fails (kMemory) if the budget does not hold this beside what the process holds; else the report tells it.
  Expected<void> require(const MemoryEstimate& estimate, std::string_view what_for);
  /// The report tells that the process will hold this beside what it holds.
  void expect(const MemoryEstimate& estimate);
};

/// That the run ends before its next view.
Error stopped();

}  // namespace quorum
