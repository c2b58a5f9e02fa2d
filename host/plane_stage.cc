#include "host/plane_stage.h"

#include <utility>

#include "engine/depth/outside_planes.h"
#include "engine/depth/support_windows.h"
#include "engine/depth/vote_depth.h"

namespace quorum {
namespace {

std::int64_t pixel_count(const SweepTask& task) {
  return std::int64_t{task.ranges.width} * std::int64_t{task.ranges.height};
}

/// The planes that the pixels begin with: as the twin does, only those that they may take.
Grid<PlaneTrial> first_trials(const SweepTask& task, const Grid<PixelVote>& first_pass,
                              const Grid<InverseDepthRange>& ranges) {
  Grid<PlaneTrial> trials = first_planes(task, first_pass);
  for (std::size_t pixel = 0; pixel < trials.values.size(); ++pixel)
    if (!may_take(trials.values[pixel], ranges.values[pixel], task.max_tilt)) trials.values[pixel] = PlaneTrial{};
  return trials;
}

}  // namespace

PlaneStage::Buffers PlaneStage::upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const {
  const SweepOptions& options = task.options;
  const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
  const std::uint64_t plane_bytes = sizeof(PixelPlane) * static_cast<std::uint64_t>(pixel_count(task));
  std::vector<Buffer> neighbors;
  for (const auto& image : task.neighbors) neighbors.push_back(commands_->upload(image->pixels));
  return {.reference = commands_->upload(task.reference->pixels),
          .windows = commands_->upload(
              make_support_windows(*task.reference, options.window, options.support_tolerance).values),
          .neighbors = std::move(neighbors),
          .ranges = commands_->upload(ranges.values),
          .last = commands_->allocate_zeros(plane_bytes),
          .best = commands_->allocate_zeros(plane_bytes),
          .trials = commands_->upload(first_trials(task, first_pass, ranges).values)};
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
  const Buffers buffers = upload(task, first_pass);
  score(task, buffers);
  refine(task, buffers, {}, 1, true);
  for (const std::vector<PlaneMove>& round : plane_rounds(task.planes, task.options.window)) {
    int tried = 0;
    for (const PlaneMove& move : round) {
      refine(task, buffers, move, tried++, false);
      score(task, buffers);
      QUORUM_TRY(commands_->submit());
    }
    refine(task, buffers, {}, tried, true);
  }
  Grid<PixelPlane> planes(task.ranges.width, task.ranges.height, kNoPlane);
  QUORUM_TRY(commands_->download(buffers.best, planes.values));
  return planes;
}

}  // namespace quorum
