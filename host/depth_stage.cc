#include "host/depth_stage.h"

#include <algorithm>
#include <utility>

#include "engine/depth/reference_windows.h"
#include "engine/depth/refine_depth.h"
#include "engine/depth/refine_planes.h"
#include "engine/depth/vote_depth.h"
#include "host/sweep_texels.h"

namespace quorum {
namespace {

constexpr std::int64_t kNccValues = 16LL << 20;  // room for a batch: 64 MiB, below any real maxStorageBufferRange
constexpr std::int64_t kMaxGroups = 65535;       // that any device allows
constexpr std::int64_t kLanesGroupSize = 16;     // invocations, each with an item
// Planes of a block: with 32 neighbors 32,768 rounds of vote_depth's loops. lavapipe stops the loops of an invocation
// after 65,535 rounds, without a word.
constexpr std::int64_t kMaxPlanes = 1024;
constexpr std::uint64_t kShareForImages = 16;  // one part in so many of the device's memory, for each worker
constexpr std::int64_t kLeastWindows = 1LL << 14;
constexpr std::int64_t kStartWindows = 1LL << 18;
constexpr std::int64_t kMostWindows = 1LL << 34;

SweepForm form_for(const DeviceInfo& device) {
  return device.kind == DeviceKind::kSoftware && device.has_float64 ? SweepForm::kLanes : SweepForm::kGroups;
}

// Shared memory that sweep_depth takes: six words per sample, five per window of a row of samples.
constexpr std::uint32_t shared_bytes(BlockSize block, int window) {
  const int rows = block.height + window - 1;
  return static_cast<std::uint32_t>(4 * rows * (6 * (block.width + window - 1) + 5 * block.width));
}

// Blocks of the second pass are smaller: the fewer pixels a block has, the fewer planes it tests that most of them
// don't. 8 x 8 fits what Vulkan promises of every device.
constexpr BlockSize second_block(SweepForm form) {
  return form == SweepForm::kLanes ? BlockSize{4, 4} : BlockSize{8, 8};
}
static_assert(shared_bytes(second_block(SweepForm::kGroups), 15) <= 16384);

BlockSize first_block(SweepForm form, int window, const DeviceInfo& device) {
  if (form == SweepForm::kLanes) return {8, 8};
  const BlockSize block{16, 16};
  return shared_bytes(block, window) <= device.shared_memory_bytes &&
                 static_cast<std::uint32_t>(block.pixels()) <= device.max_work_group_invocations
             ? block
             : second_block(form);
}

// Room for the values of a batch.
std::int64_t ncc_values(const DeviceInfo& device) {
  return std::min(kNccValues, static_cast<std::int64_t>(device.max_storage_buffer_range / sizeof(float)));
}

// Rows whose votes a kernel can see at once, in whole blocks.
int rows_of_band(int width, const DeviceInfo& device) {
  const std::uint64_t rows = device.max_storage_buffer_range / (sizeof(PixelVote) * static_cast<std::uint64_t>(width));
  constexpr std::uint64_t kMostRows = 1U << 24;
  return std::max(static_cast<int>(std::min(rows, kMostRows)) / kBlockMultiple, 1) * kBlockMultiple;
}

Grid<PlaneRange> rows_of(const Grid<PlaneRange>& ranges, int begin, int end) {
  Grid<PlaneRange> rows(ranges.width, end - begin);
  std::copy(ranges.row(begin), ranges.row(begin) + rows.values.size(), rows.values.begin());
  return rows;
}

SweepParams make_sweep_params(const SweepTask& task, BlockSize block, std::size_t neighbor, int item_count) {
  const int width = task.reference->width;
  const PaddedImage& image = *task.neighbors[neighbor];
  return {.warp = task.warps[neighbor],
          .width = width,
          .height = task.reference->height,
          .neighbor_width = image.width,
          .neighbor_height = image.height,
          .reference_stride = reference_texels_stride(width, task.options.window),
          .window_stride = whole_blocks(width),
          .item_count = item_count,
          .ncc_offset = static_cast<int>(neighbor) * item_count * (block.pixels() / 4)};
}

// height: of the band.
VoteParams make_vote_params(const SweepTask& task, BlockSize block, const SweepBatch& batch, int height) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  return {.width = task.reference->width,
          .height = height,
          .block_width = block.width,
          .block_height = block.height,
          .block_count = static_cast<int>(batch.blocks.size()),
          .item_count = static_cast<int>(batch.items.size()),
          .neighbor_count = task.neighbor_count(),
          .min_votes = rule.min_votes,
          .threshold = rule.threshold,
          .confidence_scale = rule.confidence_scale};
}

}  // namespace

DepthStage::DepthStage(Commands& commands, std::optional<SweepForm> form)
    : commands_(&commands),
      info_(&commands.device().info()),
      form_(form.value_or(form_for(*info_))),
      vote_depth_(commands.kernel(form_ == SweepForm::kLanes ? "vote_depth_lanes" : "vote_depth")),
      reference_windows_(commands, "reference_windows"),
      images_(resident_bytes(commands.device(), kShareForImages),
              [this](const PaddedImage& image) { return std::vector{commands_->upload(image.pixels)}; }),
      planes_(commands),
      planes_in_lanes_(commands),
      batch_size_(kStartWindows, kLeastWindows, kMostWindows) {}

SweepForm DepthStage::form_of(const SweepTask& task) const {
  if (task.options.is_along_axes()) return SweepForm::kGroups;
  const std::uint64_t most = std::min(info_->max_texel_buffer_elements * sizeof(Texel), info_->max_allocation);
  const auto fits = [&](const auto& image) { return quads_size(*image) <= most; };
  return fits(task.reference) && std::ranges::all_of(task.neighbors, fits) ? form_ : SweepForm::kGroups;
}

DepthStage::Pass DepthStage::make_pass(SweepForm form, const SweepOptions& options, BlockSize block) const {
  std::vector<SpecConstant> constants = {
      {"kWindow", static_cast<std::uint32_t>(options.window)},
      {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(options.window))},
      {"kBlockWidth", static_cast<std::uint32_t>(block.width)},
      {"kBlockHeight", static_cast<std::uint32_t>(block.height)}};
  if (form == SweepForm::kLanes) {
    constants.push_back({"kGroupSize", static_cast<std::uint32_t>(kLanesGroupSize)});
  } else {
    constants.push_back({"kGroupSize", static_cast<std::uint32_t>(block.pixels())});
    constants.push_back({"kAxisModel", options.is_along_axes() ? 1U : 0U});
  }
  return {block, commands_->kernel(form == SweepForm::kLanes ? "sweep_depth_lanes" : "sweep_depth", constants)};
}

void DepthStage::prepare_kernels(const SweepTask& task) {
  const SweepOptions& options = task.options;
  const SweepForm form = form_of(task);
  Sweep& sweep = sweeps_[{form, options.window, options.window_model}];
  sweep_ = &sweep;
  if (!sweep.second.kernel.empty()) return;  // the last that is made
  sweep = {.form = form,
           .first = make_pass(form, options, first_block(form, options.window, *info_)),
           .second = make_pass(form, options, second_block(form))};
}

DepthStage::Inputs DepthStage::make_inputs(const SweepTask& task) {
  const bool lanes = sweep_->form == SweepForm::kLanes;
  const int window = task.options.window;
  const BufferUse use = lanes ? BufferUse::kInParts : BufferUse::kWhole;  // as texels, or as words
  Inputs inputs;
  inputs.ncc = commands_->allocate(static_cast<std::uint64_t>(ncc_values(*info_)) * sizeof(float));
  inputs.reference =
      lanes ? commands_->upload(make_reference_texels(*task.reference, window), use) : pixels_of(task.reference);
  for (const auto& image : task.neighbors)
    inputs.neighbors.push_back(lanes ? commands_->upload(make_quads(*image), use) : pixels_of(image));
  if (lanes) {
    inputs.windows = commands_->upload(in_whole_blocks(make_reference_windows(*task.reference, window)).values, use);
  } else {
    const ReferenceWindowsParams params{.width = task.reference->width,
                                        .height = task.reference->height,
                                        .columns = whole_blocks(task.reference->width),
                                        .rows = whole_blocks(task.reference->height)};
    inputs.windows = commands_->allocate(sizeof(ReferenceWindow) * static_cast<std::uint64_t>(params.columns) *
                                         static_cast<std::uint64_t>(params.rows));
    commands_->region("reference_windows");
    commands_->dispatch(reference_windows_.at(window), {params.columns, params.rows}, params,
                        {inputs.reference, inputs.windows});
  }
  return inputs;
}

void DepthStage::record_batch(const SweepTask& task, const Inputs& inputs, const Pass& pass, const SweepBatch& batch,
                              const Band& band) {
  const std::int64_t windows_of_item = pass.block.pixels();
  const auto item_count = static_cast<std::int64_t>(batch.items.size());
  const Buffer blocks = commands_->upload(batch.blocks);
  const Buffer items = commands_->upload(batch.items);
  commands_->region("sweep_depth");
  for (std::size_t neighbor = 0; neighbor < inputs.neighbors.size(); ++neighbor)
    commands_->dispatch(pass.kernel, {sweep_->form == SweepForm::kLanes ? item_count : item_count * windows_of_item},
                        make_sweep_params(task, pass.block, neighbor, static_cast<int>(item_count)),
                        {items, inputs.reference, inputs.windows, inputs.neighbors[neighbor], inputs.ncc});
  commands_->region("vote_depth");
  commands_->dispatch(vote_depth_, {static_cast<std::int64_t>(batch.blocks.size()) * windows_of_item / 4},
                      make_vote_params(task, pass.block, batch, band.height),
                      {blocks, items, band.ranges, inputs.ncc, band.votes});
}

DepthStage::Band DepthStage::make_band(const Grid<PlaneRange>& ranges) const {
  const std::vector<PixelVote> none(ranges.values.size(), kNoVote);
  return {ranges.height, commands_->upload(ranges.values), commands_->upload(none)};
}

Expected<void> DepthStage::run_band(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges,
                                    const Pass& pass, int stride, int row_begin, const Band& band, Pacer& pacer) {
  const std::int64_t item_windows = std::int64_t{pass.block.pixels()} * task.neighbor_count();
  const std::int64_t max_items = kMaxGroups * (sweep_->form == SweepForm::kLanes ? kLanesGroupSize : 1);
  SweepBatches batches(ranges, task.planes.inverse_depth, pass.block, stride);
  while (true) {
    QUORUM_TRY(pacer.make_room(item_windows));
    const std::int64_t windows = std::min(pacer.room(), ncc_values(*info_));
    SweepBatch batch = batches.next(std::clamp<std::int64_t>(windows / item_windows, 1, max_items), kMaxPlanes);
    if (batch.items.empty()) return {};
    for (SweepItem& item : batch.items) item.y += row_begin;  // items lie in the view, blocks in the band
    record_batch(task, inputs, pass, batch, band);
    QUORUM_TRY(pacer.recorded(static_cast<std::int64_t>(batch.items.size()) * item_windows));
  }
}

Expected<Grid<PixelVote>> DepthStage::run_pass(const SweepTask& task, const Inputs& inputs,
                                               const Grid<PlaneRange>& ranges, const Pass& pass, int stride) {
  Grid<PixelVote> votes(ranges.width, ranges.height, kNoVote);
  Pacer pacer(*commands_, batch_size_);
  const int rows = rows_of_band(ranges.width, *info_);
  for (int begin = 0; begin < ranges.height; begin += rows) {
    const Grid<PlaneRange> part = rows_of(ranges, begin, std::min(begin + rows, ranges.height));
    const Band band = make_band(part);
    QUORUM_TRY(run_band(task, inputs, part, pass, stride, begin, band, pacer));
    QUORUM_TRY(commands_->download(band.votes, std::span<PixelVote>(votes.row(begin), part.values.size())));
    pacer.submitted();
  }
  return votes;
}

Expected<DepthMap> DepthStage::sweep_twice(const SweepTask& task, const Inputs& inputs) {
  auto votes = run_pass(task, inputs, task.ranges, sweep_->first, task.planes.refinement);
  if (votes && task.planes.refinement > 1)
    votes = run_pass(task, inputs, refine_ranges(*votes, task.planes), sweep_->second, 1);
  if (!votes) return std::unexpected(votes.error());
  return depth_map_from_votes(*votes, task.planes);
}

Expected<DepthMap> DepthStage::sweep_slanted(const SweepTask& task, Inputs inputs) {
  if (form_ == SweepForm::kLanes && planes_in_lanes_.fits(task)) {
    QUORUM_ASSIGN(const auto votes, run_pass(task, inputs, task.ranges, sweep_->first, task.planes.refinement));
    inputs = {};  // leaves their memory to the planes
    QUORUM_ASSIGN(const auto planes, planes_in_lanes_.run(task, votes));
    return depth_map_from_planes(planes, task);
  }
  if (!planes_.fits(task)) {  // on the CPU, with the same bytes
    QUORUM_ASSIGN(const auto votes, run_pass(task, inputs, task.ranges, sweep_->first, task.planes.refinement));
    return depth_map_from_planes(refine_planes(task, votes, {}), task);
  }
  Band band = make_band(task.ranges);
  Pacer pacer(*commands_, batch_size_);
  QUORUM_TRY(run_band(task, inputs, task.ranges, sweep_->first, task.planes.refinement, 0, band, pacer));
  QUORUM_TRY(pacer.submit());
  SweptView swept;
  if (sweep_->form == SweepForm::kGroups) {
    swept.reference = inputs.reference;
    swept.neighbors = std::move(inputs.neighbors);
  } else {
    swept.reference = pixels_of(task.reference);
    for (const auto& image : task.neighbors) swept.neighbors.push_back(pixels_of(image));
  }
  inputs = {};
  swept.ranges = std::move(band.ranges);
  swept.votes = std::move(band.votes);
  QUORUM_ASSIGN(const auto planes, planes_.run(task, swept));
  return depth_map_from_planes(planes, task);
}

Expected<DepthMap> DepthStage::sweep(const SweepTask& task) {
  prepare_kernels(task);
  Inputs inputs = make_inputs(task);
  return task.options.is_slanted() ? sweep_slanted(task, std::move(inputs)) : sweep_twice(task, inputs);
}

Expected<DepthMap> DepthStage::run(const SweepTask& task) {
  auto map = sweep(task);
  if (!map) forget();
  return map;
}

}  // namespace quorum
