#include "host/depth_stage.h"

#include <algorithm>
#include <utility>

#include "engine/depth/refine_depth.h"
#include "engine/depth/vote_depth.h"
#include "host/kernel_table.h"

namespace quorum {
namespace {

constexpr std::uint32_t kStripRows = 16;         // pixels of a column that one invocation of sweep_depth takes
constexpr std::int64_t kNccValues = 16LL << 20;  // room for a batch: 64 MiB, below any maxStorageBufferRange
constexpr std::int64_t kMaxSlots = 1024;  // with 32 neighbors: 32,768 rounds of vote_depth's loops. lavapipe stops the
                                          // loops of an invocation after 65,535 rounds, without a word
constexpr std::int64_t kLeastWindows = 1LL << 14;
constexpr std::int64_t kStartWindows = 1LL << 18;

/// A batch of a pass: rows of the view, and slots of planes.
struct Batch {
  int row_begin;
  int row_count;
  int first_slot;
  int slot_count;
};

SweepParams make_sweep_params(const SweepTask& task, std::size_t neighbor, const Batch& batch, int stride) {
  const int width = task.reference->width;
  const PaddedImage& image = *task.neighbors[neighbor];
  return {.warp = task.warps[neighbor],
          .width = width,
          .height = task.reference->height,
          .neighbor_width = image.width,
          .neighbor_height = image.height,
          .row_begin = batch.row_begin,
          .row_count = batch.row_count,
          .first_plane = batch.first_slot * stride,
          .plane_stride = stride,
          .plane_count = batch.slot_count,
          .ncc_offset = static_cast<int>(neighbor) * batch.slot_count * batch.row_count * width};
}

VoteParams make_vote_params(const SweepTask& task, const Batch& batch, int stride, bool relative) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  return {.width = task.reference->width,
          .row_begin = batch.row_begin,
          .row_count = batch.row_count,
          .first_plane = batch.first_slot * stride,
          .plane_stride = stride,
          .plane_count = batch.slot_count,
          .neighbor_count = task.neighbor_count(),
          .min_votes = rule.min_votes,
          .threshold = rule.threshold,
          .confidence_scale = rule.confidence_scale,
          .relative_planes = relative ? 1 : 0};
}

/// First and last slot that some pixel of the rows tests; first > last if none does.
std::pair<int, int> slots_of_rows(const Grid<PlaneRange>& ranges, int row_begin, int row_count, int stride,
                                  bool relative) {
  int first = 1 << 30;
  int last = -1;
  for (int y = row_begin; y < row_begin + row_count; ++y) {
    for (int x = 0; x < ranges.width; ++x) {
      const PlaneRange& range = ranges.at(x, y);
      if (range.first > range.last) continue;
      first = std::min(first, relative ? 0 : static_cast<int>(range.first) / stride);
      last = std::max(last, static_cast<int>(relative ? range.last - range.first : range.last) / stride);
    }
  }
  return {first, last};
}

}  // namespace

Expected<DepthStage> DepthStage::create(const Device& device, Commands& commands) {
  auto vote_depth = Kernel::create(device, find_kernel("vote_depth"));
  if (!vote_depth) return std::unexpected(vote_depth.error());
  return DepthStage(device, commands, std::move(*vote_depth));
}

DepthStage::DepthStage(const Device& device, Commands& commands, Kernel vote_depth)
    : device_(&device),
      commands_(&commands),
      vote_depth_(std::move(vote_depth)),
      sweep_batch_(kStartWindows, kLeastWindows, kNccValues),
      refine_batch_(kStartWindows, kLeastWindows, kNccValues) {}

Expected<void> DepthStage::prepare_kernels(const SweepOptions& options) {
  if (kernels_ && kernels_->window == options.window && kernels_->model == options.window_model) return {};
  const auto window = static_cast<std::uint32_t>(options.window);
  const auto shift = static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(options.window));
  const std::uint32_t axis = options.window_model == WindowModel::kAxis ? 1 : 0;
  auto sweep_depth =
      Kernel::create(*device_, find_kernel("sweep_depth"),
                     {{"kWindow", window}, {"kAxisModel", axis}, {"kShift", shift}, {"kStripRows", kStripRows}});
  if (!sweep_depth) return std::unexpected(sweep_depth.error());
  auto refine_depth = Kernel::create(*device_, find_kernel("refine_depth"),
                                     {{"kWindow", window}, {"kAxisModel", axis}, {"kShift", shift}});
  if (!refine_depth) return std::unexpected(refine_depth.error());
  kernels_.emplace(Kernels{options.window, options.window_model, std::move(*sweep_depth), std::move(*refine_depth)});
  return {};
}

Expected<DepthStage::Inputs> DepthStage::upload(const SweepTask& task) const {
  auto reference = Buffer::of(*device_, task.reference->pixels);
  if (!reference) return std::unexpected(reference.error());
  std::vector<Buffer> neighbors;
  for (const auto& image : task.neighbors) {
    auto neighbor = Buffer::of(*device_, image->pixels);
    if (!neighbor) return std::unexpected(neighbor.error());
    neighbors.push_back(std::move(*neighbor));
  }
  auto planes = Buffer::of(*device_, task.planes.inverse_depth);
  if (!planes) return std::unexpected(planes.error());
  const auto one_row = static_cast<std::int64_t>(task.neighbor_count()) * task.reference->width;
  auto ncc = Buffer::create(*device_, static_cast<std::uint64_t>(std::max(kNccValues, one_row)) * sizeof(float));
  if (!ncc) return std::unexpected(ncc.error());
  return Inputs{std::move(*reference), std::move(neighbors), std::move(*planes), std::move(*ncc)};
}

Expected<Grid<PixelVote>> DepthStage::run_pass(const SweepTask& task, const Inputs& inputs,
                                               const Grid<PlaneRange>& ranges, Pass pass) {
  Grid<PixelVote> votes(ranges.width, ranges.height, kNoVote);
  auto range_buffer = Buffer::of(*device_, ranges.values);
  if (!range_buffer) return std::unexpected(range_buffer.error());
  auto vote_buffer = Buffer::of(*device_, votes.values);
  if (!vote_buffer) return std::unexpected(vote_buffer.error());

  const bool sweep = pass == Pass::kSweep;
  const int stride = sweep ? task.planes.refinement : 1;
  const Kernel& kernel = sweep ? kernels_->sweep_depth : kernels_->refine_depth;
  BatchSize& size = sweep ? sweep_batch_ : refine_batch_;
  const std::int64_t row_windows = static_cast<std::int64_t>(ranges.width) * task.neighbor_count();
  for (int row = 0; row < ranges.height;) {
    const int rows = static_cast<int>(std::clamp<std::int64_t>(size.items() / row_windows, 1, ranges.height - row));
    const auto [first_slot, last_slot] = slots_of_rows(ranges, row, rows, stride, !sweep);
    for (int slot = first_slot; slot <= last_slot;) {
      const std::int64_t windows_of_slot = row_windows * rows;
      const Batch batch{
          row, rows, slot,
          static_cast<int>(std::clamp<std::int64_t>(std::min(size.items(), kNccValues) / windows_of_slot, 1,
                                                    std::min<std::int64_t>(last_slot - slot + 1, kMaxSlots)))};
      const std::int64_t strips = sweep ? (rows + kStripRows - 1) / kStripRows : rows;
      commands_->region(sweep ? "sweep_depth" : "refine_depth");
      for (std::size_t neighbor = 0; neighbor < inputs.neighbors.size(); ++neighbor)
        commands_->dispatch(kernel, {ranges.width, strips, batch.slot_count},
                            make_sweep_params(task, neighbor, batch, stride),
                            {inputs.reference, inputs.neighbors[neighbor], inputs.planes, *range_buffer, inputs.ncc});
      commands_->region("vote_depth");
      commands_->dispatch(vote_depth_, {ranges.width, rows}, make_vote_params(task, batch, stride, !sweep),
                          {*range_buffer, inputs.ncc, *vote_buffer});
      if (auto done = commands_->submit(); !done) return std::unexpected(done.error());
      size.measured(windows_of_slot * batch.slot_count, commands_->last_submission_seconds());
      slot += batch.slot_count;
    }
    row += rows;
  }
  if (auto read = vote_buffer->download(votes.values); !read) return std::unexpected(read.error());
  return votes;
}

Expected<DepthMap> DepthStage::run(const SweepTask& task) {
  if (auto ready = prepare_kernels(task.options); !ready) return std::unexpected(ready.error());
  auto inputs = upload(task);
  if (!inputs) return std::unexpected(inputs.error());
  auto votes = run_pass(task, *inputs, task.ranges, Pass::kSweep);
  if (votes && task.planes.refinement > 1)
    votes = run_pass(task, *inputs, refine_ranges(*votes, task.planes), Pass::kRefine);
  if (!votes) return std::unexpected(votes.error());
  return depth_map_from_votes(*votes, task.planes);
}

}  // namespace quorum
