#include "host/plane_stage.h"

#include <algorithm>
#include <utility>

#include "engine/depth/fit_planes.h"
#include "engine/depth/vote_depth.h"

namespace quorum {
namespace {

constexpr std::int64_t kGroupSide = 8;  // pixels, of all three kernels
constexpr std::int64_t kInvocationsInStep = 64;
constexpr std::int64_t kStartWindows = 1LL << 20;
constexpr std::int64_t kLeastWindows = 1LL << 14;
constexpr std::int64_t kMostWindows = 1LL << 34;

/// The images of a task behind each other: where each begins, in pixels.
std::vector<PlaneNeighbor> place_neighbors(const SweepTask& task) {
  std::vector<PlaneNeighbor> neighbors;
  std::size_t first = task.reference->pixels.size();
  for (std::size_t i = 0; i < task.neighbors.size(); ++i) {
    const PaddedImage& image = *task.neighbors[i];
    neighbors.push_back({task.warps[i], image.width, image.height, static_cast<int>(first), 0});
    first += image.pixels.size();
  }
  return neighbors;
}

Buffer join_images(Commands& commands, const SweptView& swept) {
  std::uint64_t bytes = swept.reference.size();
  for (const Buffer& image : swept.neighbors) bytes += image.size();
  const Buffer all = commands.allocate(bytes);
  commands.copy(swept.reference, all);
  std::uint64_t offset = swept.reference.size();
  for (const Buffer& image : swept.neighbors) {
    commands.copy(image, all, offset);
    offset += image.size();
  }
  return all;
}

/// Moves that an invocation may go through at once: its loops may go around so often, of all that run in lockstep
/// together.
std::int64_t most_moves(const SweepTask& task, std::uint32_t max_loop_iterations) {
  const std::int64_t window = task.options.window;
  const std::int64_t of_move = task.neighbor_count() * (1 + window * (window + 1)) + kInvocationsInStep;
  return std::max<std::int64_t>(1, (std::int64_t{max_loop_iterations} - kInvocationsInStep) / of_move);
}

}  // namespace

PlaneStage::PlaneStage(Commands& commands)
    : commands_(&commands),
      first_planes_(commands.kernel("first_planes")),
      support_windows_(commands, "support_windows"),
      refine_planes_(commands, "refine_planes") {}

bool PlaneStage::fits(const SweepTask& task) const {
  const DeviceInfo& info = commands_->device().info();
  std::uint64_t images = task.reference->pixels.size() * sizeof(Rgba);
  for (const auto& image : task.neighbors) images += image->pixels.size() * sizeof(Rgba);
  const std::uint64_t largest = std::max<std::uint64_t>(images, sizeof(PixelPlane) * task.ranges.values.size());
  return largest <= std::min(info.max_storage_buffer_range, info.max_allocation);
}

PlaneStage::Buffers PlaneStage::prepare(const SweepTask& task, const SweptView& swept) {
  const int width = task.ranges.width;
  const int height = task.ranges.height;
  const std::uint64_t pixels = task.ranges.values.size();
  const std::vector<OutsidePlane> nothing(1);
  const auto& outside = task.outside.empty() ? nothing : task.outside.values;
  Buffers buffers{.images = join_images(*commands_, swept),
                  .neighbors = commands_->upload(place_neighbors(task)),
                  .windows = commands_->allocate(sizeof(SupportWindow) * pixels),
                  .ranges = commands_->allocate(sizeof(InverseDepthRange) * pixels),
                  .last = commands_->allocate(sizeof(PixelPlane) * pixels),
                  .best = commands_->allocate(sizeof(PixelPlane) * pixels)};
  const Buffer inverse_depths = commands_->upload(task.planes.inverse_depth);
  const Buffer outside_planes = commands_->upload(outside);
  commands_->region("support_windows");
  commands_->dispatch(support_windows_.at(task.options.window), {width, height},
                      SupportWindowsParams{width, height, task.options.support_tolerance},
                      {swept.reference, buffers.windows});
  commands_->region("first_planes");
  commands_->dispatch(first_planes_, {width, height},
                      FirstPlanesParams{.width = width,
                                        .height = height,
                                        .outside_width = task.outside.width,
                                        .outside_height = task.outside.height,
                                        .outside_halvings = task.outside_halvings,
                                        .limit = fit_limit(task.planes)},
                      {swept.votes, swept.ranges, inverse_depths, outside_planes, buffers.ranges, buffers.last});
  return buffers;
}

Expected<void> PlaneStage::run_round(const SweepTask& task, Buffers& buffers, const std::vector<PlaneMove>& moves,
                                     bool is_first, Pacer& pacer) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  const Buffer move_buffer = commands_->upload(moves);
  const std::int64_t width = task.ranges.width;
  const std::int64_t height = task.ranges.height;
  const auto move_count = static_cast<std::int64_t>(moves.size());
  const std::int64_t some_moves =
      std::min(move_count, most_moves(task, commands_->device().info().max_loop_iterations));
  commands_->region("refine_planes");
  for (std::int64_t begin = 0; begin < height;) {
    const std::int64_t row_windows = width * move_count * task.neighbor_count();
    QUORUM_TRY(pacer.make_room(kGroupSide * row_windows));
    const std::int64_t groups = std::max<std::int64_t>(1, pacer.room() / row_windows / kGroupSide);
    const std::int64_t end = std::min(height, begin + groups * kGroupSide);
    for (std::int64_t move = 0; move < move_count; move += some_moves) {
      const RefinePlanesParams params{.width = task.ranges.width,
                                      .height = task.ranges.height,
                                      .row_begin = static_cast<int>(begin),
                                      .row_end = static_cast<int>(end),
                                      .move_begin = static_cast<int>(move),
                                      .move_end = static_cast<int>(std::min(move_count, move + some_moves)),
                                      .neighbor_count = task.neighbor_count(),
                                      .is_first = is_first ? 1 : 0,
                                      .min_votes = rule.min_votes,
                                      .max_tilt = task.max_tilt,
                                      .threshold = rule.threshold,
                                      .confidence_scale = rule.confidence_scale};
      commands_->dispatch(refine_planes_.at(task.options.window), {width, end - begin}, params,
                          {move_buffer, buffers.neighbors, buffers.ranges, buffers.windows, buffers.images,
                           buffers.last, buffers.best});
    }
    QUORUM_TRY(pacer.recorded((end - begin) * row_windows));
    begin = end;
  }
  std::swap(buffers.last, buffers.best);
  return {};
}

Expected<Grid<PixelPlane>> PlaneStage::run(const SweepTask& task, const SweptView& swept) {
  Buffers buffers = prepare(task, swept);
  BatchSize& size =
      batch_sizes_.try_emplace(task.options.window, kStartWindows, kLeastWindows, kMostWindows).first->second;
  Pacer pacer(*commands_, size);
  QUORUM_TRY(run_round(task, buffers, {PlaneMove{}}, true, pacer));
  for (const std::vector<PlaneMove>& round : plane_rounds(task.planes, task.options.window))
    QUORUM_TRY(run_round(task, buffers, round, false, pacer));
  Grid<PixelPlane> planes(task.ranges.width, task.ranges.height, kNoPlane);
  QUORUM_TRY(commands_->download(buffers.last, planes.values));
  pacer.submitted();
  return planes;
}

}  // namespace quorum
