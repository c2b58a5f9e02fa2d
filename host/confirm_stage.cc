#include "host/confirm_stage.h"

#include "host/buffer.h"

namespace quorum {

Expected<Grid<float>> ConfirmStage::run(const ConfirmTask& task) {
  const Grid<float>& depth = task.view.depth;
  Grid<int> support(depth.width, depth.height);
  const Buffer depth_buffer = commands_->upload(depth.values);
  const Buffer certainty_buffer =
      task.view.certainty.empty() ? depth_buffer : commands_->upload(task.view.certainty.values);
  const Buffer support_buffer = commands_->upload(support.values);
  commands_->region("confirm_depths");
  for (std::size_t other = 0; other < task.others.size(); ++other) {
    const ViewDepths& seen_by = task.others[other];
    const Buffer other_buffer = commands_->upload(seen_by.depth.values);
    const Buffer other_certainty =
        seen_by.certainty.empty() ? other_buffer : commands_->upload(seen_by.certainty.values);
    commands_->dispatch(confirm_depths_, {depth.width, depth.height}, make_confirm_depths_params(task, other),
                        {depth_buffer, other_buffer, certainty_buffer, other_certainty, support_buffer});
    QUORUM_TRY(commands_->submit());
  }
  QUORUM_TRY(commands_->download(support_buffer, support.values));
  return certainty_map(depth, support);
}

}  // namespace quorum
