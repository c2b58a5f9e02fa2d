#include "engine/pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/memory.h"

namespace quorum {

Expected<std::vector<int>> Run::views_with_depth_map() const {
  std::vector<int> views;
  for (int index = 0; index < static_cast<int>(scene.views.size()); ++index)
    if (workspace.has_depth_map(view(index).name)) views.push_back(index);
  if (views.empty())
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depth map of this scene; run `quorum depth` first",
                                                  (workspace.folder() / "depth").string()));
  return views;
}

Expected<void> Run::require(const MemoryEstimate& estimate, std::string_view what_for) {
  report.memory_budget_bytes = budget.bytes();
  QUORUM_TRY(budget.require(estimate.total(), what_for));
  expect(estimate);
  return {};
}

void Run::expect(const MemoryEstimate& estimate) {
  report.estimated_memory_bytes = std::max(report.estimated_memory_bytes, resident_bytes() + estimate.total());
}

Error stopped() {
  return {ErrorKind::kStopped, "stopped as asked; what is finished is kept, and the same command goes on from there"};
}

}  // namespace quorum
