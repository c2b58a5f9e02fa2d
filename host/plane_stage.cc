#include "host/plane_stage.h"

#include <utility>

#include "engine/depth/fit_planes.h"
#include "engine/depth/support_windows.h"
#include "engine/depth/vote_depth.h"
#include "host/kernel_table.h"

namespace quorum {
namespace {

std::int64_t pixel_count(const SweepTask& task) {
  return std::int64_t{task.ranges.width} * std::int64_t{task.ranges.height};
}

/// The planes that the pixels begin with: as the twin does, only those that they may take.
Grid<PlaneTrial> first_trials(const SweepTask& task, const Grid<PixelVote>& first_pass,
                              const Grid<InverseDepthRange>& ranges) {
  Grid<PlaneTrial> trials = fit_planes(first_pass, task.planes);
  for (std::size_t pixel = 0; pixel < trials.values.size(); ++pixel)
    if (!may_take(trials.values[pixel], ranges.values[pixel], task.max_tilt)) trials.values[pixel] = PlaneTrial{};
  return trials;
}

}  // namespace

Expected<PlaneStage> PlaneStage::create(const Device& device, Commands& commands) {
  auto refine_planes = Kernel::create(device, find_kernel("refine_planes"));
  if (!refine_planes) return std::unexpected(refine_planes.error());
  return PlaneStage(device, commands, std::move(*refine_planes));
}

PlaneStage::PlaneStage(const Device& device, Commands& commands, Kernel refine_planes)
    : device_(&device),
      commands_(&commands),
      refine_planes_(std::move(refine_planes)),
      score_planes_(device, "score_planes") {}

Expected<PlaneStage::Buffers> PlaneStage::upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const {
  auto reference = Buffer::of(*device_, task.reference->pixels);
  if (!reference) return std::unexpected(reference.error());
  auto windows = Buffer::of(
      *device_, make_support_windows(*task.reference, task.options.window, task.options.support_tolerance).values);
  if (!windows) return std::unexpected(windows.error());
  std::vector<Buffer> neighbors;
  for (const auto& image : task.neighbors) {
    auto neighbor = Buffer::of(*device_, image->pixels);
    if (!neighbor) return std::unexpected(neighbor.error());
    neighbors.push_back(std::move(*neighbor));
  }
  const Grid<InverseDepthRange> depth_ranges = inverse_depth_ranges(task.ranges, task.planes);
  auto ranges = Buffer::of(*device_, depth_ranges.values);
  if (!ranges) return std::unexpected(ranges.error());
  auto trials = Buffer::of(*device_, first_trials(task, first_pass, depth_ranges).values);
  if (!trials) return std::unexpected(trials.error());
  const std::uint64_t plane_bytes = sizeof(PixelPlane) * static_cast<std::uint64_t>(pixel_count(task));
  auto last = Buffer::create(*device_, plane_bytes);
  if (!last) return std::unexpected(last.error());
  auto best = Buffer::create(*device_, plane_bytes);
  if (!best) return std::unexpected(best.error());
  for (Buffer* planes : {&*last, &*best})
    if (auto cleared = planes->fill_zero(); !cleared) return std::unexpected(cleared.error());
  return Buffers{std::move(*reference), std::move(*windows), std::move(neighbors), std::move(*ranges),
                 std::move(*last),      std::move(*best),    std::move(*trials)};
}

void PlaneStage::score(const SweepTask& task, const Buffers& buffers) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  commands_->region("score_planes");
  for (std::size_t neighbor = 0; neighbor < buffers.neighbors.size(); ++neighbor) {
    const ScorePlanesParams params{.warp = task.warps[neighbor],
                                   .width = task.ranges.width,
                                   .height = task.ranges.height,
                                   .neighbor_width = task.neighbors[neighbor]->width,
                                   .neighbor_height = task.neighbors[neighbor]->height,
                                   .left = task.neighbor_count() - 1 - static_cast<int>(neighbor),
                                   .min_votes = rule.min_votes,
                                   .threshold = rule.threshold,
                                   .confidence_scale = rule.confidence_scale};
    commands_->dispatch(
        score_planes_.at(task.options.window), {pixel_count(task)}, params,
        {buffers.reference, buffers.windows, buffers.neighbors[neighbor], buffers.best, buffers.trials});
  }
}

void PlaneStage::refine(const SweepTask& task, const Buffers& buffers, const PlaneMove& move, int tried,
                        bool ends_round) {
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  const RefinePlanesParams params{.move = move,
                                  .width = task.ranges.width,
                                  .height = task.ranges.height,
                                  .tried = tried,
                                  .ends_round = ends_round ? 1 : 0,
                                  .max_tilt = task.max_tilt,
                                  .threshold = rule.threshold,
                                  .confidence_scale = rule.confidence_scale};
  commands_->region("refine_planes");
  commands_->dispatch(refine_planes_, {pixel_count(task)}, params,
                      {buffers.ranges, buffers.last, buffers.best, buffers.trials});
}

Expected<Grid<PixelPlane>> PlaneStage::run(const SweepTask& task, const Grid<PixelVote>& first_pass) {
  if (auto ready = score_planes_.prepare(task.options.window); !ready) return std::unexpected(ready.error());
  const auto buffers = upload(task, first_pass);
  if (!buffers) return std::unexpected(buffers.error());
  score(task, *buffers);
  refine(task, *buffers, {}, 1, true);
  for (const std::vector<PlaneMove>& round : plane_rounds(task.planes, task.options.window)) {
    int tried = 0;
    for (const PlaneMove& move : round) {
      refine(task, *buffers, move, tried++, false);
      score(task, *buffers);
      if (auto done = commands_->submit(); !done) return std::unexpected(done.error());
    }
    refine(task, *buffers, {}, tried, true);
  }
  if (auto done = commands_->submit(); !done) return std::unexpected(done.error());
  Grid<PixelPlane> planes(task.ranges.width, task.ranges.height, kNoPlane);
  if (auto read = buffers->best.download(planes.values); !read) return std::unexpected(read.error());
  return planes;
}

}  // namespace quorum
