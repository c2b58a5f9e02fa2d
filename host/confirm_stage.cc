#include "host/confirm_stage.h"

#include "host/buffer.h"

namespace quorum {
namespace {

constexpr std::uint64_t kShareForViews = 32;  // one part in so many of the device's memory, for each worker

}  // namespace

ConfirmStage::ConfirmStage(Commands& commands)
    : commands_(&commands),
      confirm_depths_(commands.kernel("confirm_depths")),
      views_(resident_bytes(commands.device(), kShareForViews),
             [this](const ViewDepths& view) { return upload(view); }) {}

std::vector<Buffer> ConfirmStage::upload(const ViewDepths& view) const {
  const Buffer depth = commands_->upload(view.depth.values);
  return {depth, view.certainty.empty() ? depth : commands_->upload(view.certainty.values)};
}

Expected<Grid<float>> ConfirmStage::run(const ConfirmTask& task) {
  const Grid<float>& depth = task.view->depth;
  Grid<int> support(depth.width, depth.height);
  const std::vector<Buffer> view = views_.of(task.view);
  const Buffer support_buffer = commands_->allocate_zeros(sizeof(int) * support.values.size());
  for (std::size_t other = 0; other < task.others.size(); ++other) {
    const std::vector<Buffer> seen_by = views_.of(task.others[other]);
    commands_->region("confirm_depths");
    commands_->dispatch(confirm_depths_, {depth.width, depth.height}, make_confirm_depths_params(task, other),
                        {view[0], seen_by[0], view[1], seen_by[1], support_buffer});
  }
  if (auto done = commands_->download(support_buffer, support.values); !done) {
    forget();
    return std::unexpected(std::move(done.error()));
  }
  return certainty_map(depth, support);
}

}  // namespace quorum
