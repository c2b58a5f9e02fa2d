#include "host/confirm_stage.h"

#include <utility>

#include "host/buffer.h"
#include "host/kernel_table.h"

namespace quorum {

Expected<ConfirmStage> ConfirmStage::create(const Device& device, Commands& commands) {
  auto confirm_depths = Kernel::create(device, find_kernel("confirm_depths"));
  if (!confirm_depths) return std::unexpected(confirm_depths.error());
  return ConfirmStage(device, commands, std::move(*confirm_depths));
}

Expected<Grid<float>> ConfirmStage::run(const ConfirmTask& task) {
  const Grid<float>& depth = task.view.depth;
  Grid<int> support(depth.width, depth.height);
  auto depth_buffer = Buffer::of(*device_, depth.values);
  if (!depth_buffer) return std::unexpected(depth_buffer.error());
  auto support_buffer = Buffer::of(*device_, support.values);
  if (!support_buffer) return std::unexpected(support_buffer.error());
  for (std::size_t other = 0; other < task.others.size(); ++other) {
    auto other_buffer = Buffer::of(*device_, task.others[other].depth.values);
    if (!other_buffer) return std::unexpected(other_buffer.error());
    commands_->region("confirm_depths");
    commands_->dispatch(confirm_depths_, {depth.width, depth.height}, make_confirm_depths_params(task, other),
                        {*depth_buffer, *other_buffer, *support_buffer});
    if (auto done = commands_->submit(); !done) return std::unexpected(done.error());
  }
  if (auto read = support_buffer->download(support.values); !read) return std::unexpected(read.error());
  return certainty_map(depth, support);
}

}  // namespace quorum
