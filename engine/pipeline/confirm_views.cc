#include "engine/pipeline/confirm_views.h"

#include <algorithm>

#include "engine/pipeline/background_thread.h"
#include "engine/pipeline/memory_budget.h"

namespace quorum {
namespace {

const View& view_at(const Scene& scene, int index) { return scene.views[static_cast<std::size_t>(index)]; }

/// The other views that a view is compared with. views: with a depth map, ascending.
std::vector<int> select_others(const Scene& scene, int view, const std::vector<int>& views,
                               const ReconstructOptions& options) {
  SelectViewsOptions rule = options.views;
  rule.neighbor_count = kConfirmingViews;
  std::vector<int> others = select_views(scene, view, rule);
  std::erase_if(others, [&](int other) { return !std::ranges::binary_search(views, other); });
  return others;
}

Expected<ConfirmTask> read_task(const Scene& scene, int view, const std::vector<int>& others,
                                const FusionOptions& fusion, const Workspace& workspace) {
  const auto read = [&](int index) -> Expected<ViewDepths> {
    const View& source = view_at(scene, index);
    auto depth = workspace.load_depth(source.name, source.width, source.height);
    if (!depth) return std::unexpected(depth.error());
    return ViewDepths{std::move(*depth), source.camera};
  };
  auto depths = read(view);
  if (!depths) return std::unexpected(depths.error());
  ConfirmTask task{std::move(*depths), {}, fusion};
  for (const int other : others) {
    auto other_depths = read(other);
    if (!other_depths) return std::unexpected(other_depths.error());
    task.others.push_back(std::move(*other_depths));
  }
  return task;
}

/// What a view takes at most: its depths and its others', and the next view's, which are read meanwhile; support and
/// certainty; the certainty of the last view, which is written meanwhile, with its picture and a file's bytes.
std::uint64_t view_bytes(const Scene& scene, const std::vector<int>& views, const Backend& backend) {
  constexpr std::uint64_t kPixelBytes = 2 * 4 * (1 + kConfirmingViews) + 4 + 8 + 16;
  std::uint64_t pixels = 0;
  for (const int index : views) {
    const View& view = view_at(scene, index);
    pixels = std::max(pixels, static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height));
  }
  return kPixelBytes * pixels + backend.view_bytes(pixels, 0);
}

}  // namespace

Expected<void> confirm_views(const Scene& scene, const std::vector<int>& views, const ReconstructOptions& options,
                             Backend& backend, const Workspace& workspace, Progress& progress, RunReport& report) {
  if (auto fits = MemoryBudget(options.memory_bytes).require(view_bytes(scene, views, backend), "confirming depths");
      !fits)
    return fits;
  progress.stage("confirming depths", static_cast<int>(views.size()));

  // While one view is confirmed, the next one's depths are read and the last one's certainty is written.
  BackgroundThread reader;
  BackgroundThread writer;
  const auto read = [&](int view) {
    return reader.run([&scene, &options, &workspace, view, others = select_others(scene, view, views, options)] {
      return read_task(scene, view, others, options.fusion, workspace);
    });
  };
  std::future<Expected<ConfirmTask>> reading;
  if (!views.empty()) reading = read(views[0]);
  std::future<Expected<void>> writing = writer.run([] { return Expected<void>(); });
  for (std::size_t place = 0; place < views.size(); ++place) {
    if (progress.stop_requested())
      return failure(ErrorKind::kStopped, "stopped as asked; finished depth maps are kept");
    const std::string& name = view_at(scene, views[place]).name;
    const Expected<ConfirmTask> task = reading.get();
    if (place + 1 < views.size()) reading = read(views[place + 1]);
    if (!task) return std::unexpected(task.error());
    Expected<Grid<float>> certainty = failure(ErrorKind::kInput, "");
    {
      const StageTimer timer(report, "confirm_depths");
      certainty = backend.confirm_depths(*task);
    }
    if (!certainty) return std::unexpected(certainty.error().within(name));
    if (auto saved = writing.get(); !saved) return saved;
    writing =
        writer.run([&workspace, &name, map = std::move(*certainty)] { return workspace.save_certainty(name, map); });
    progress.step();
  }
  if (auto saved = writing.get(); !saved) return saved;
  add_stage(report, reader.time("load_depth_maps"));
  add_stage(report, writer.time("save_certainty"));
  return {};
}

}  // namespace quorum
