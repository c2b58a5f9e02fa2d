#include "host/confirm_stage.h"

#include "host/buffer.h"

namespace quorum {

Expected<Grid<float>> ConfirmStage::run(const ConfirmTask& task) {
  const Grid<float>& depth = task.view.depth;
  Grid<int> support(depth.width, depth.height);
  const Buffer depth_buffer = commands_->upload(depth.values);
  const Buffer support_buffer = commands_->upload(support.values);
  commands_->region("confirm_depths");
  for (std::size_t other = 0; other < task.others.size(); ++other) {
    const Buffer other_buffer = commands_->upload(task.others[other].depth.values);
    commands_->dispatch(confirm_depths_, {depth.width, depth.height}, make_confirm_depths_params(task, other),
                        {depth_buffer, other_buffer, support_buffer});
    QUORUM_TRY(commands_->submit());
  }
  QUORUM_TRY(commands_->download(support_buffer, support.values));
  return certainty_map(depth, support);
}

}  // namespace quorum
