#include "host/plane_lanes_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/depth/first_planes.h"
#include "engine/depth/support_windows.h"
#include "engine/depth/vote_depth.h"
#include "host/sweep_texels.h"

namespace quorum {
namespace {

constexpr std::int64_t kLanes = 8;                   // invocations of a work group, each with a column
constexpr std::int64_t kRowsPerLane = 32;            // enough that the lanes of a group end at about the same time
constexpr std::int64_t kSamplesOfRun = 400'000'000;  // of a submission, at most: seconds
constexpr std::int64_t kViewMultiple = 64;           // pixels, so that the views of a run are aligned

std::uint64_t quad_count(const PaddedImage& image) { return quads_size(image) / sizeof(Texel); }

std::uint64_t all_quads(const SweepTask& task) {
  std::uint64_t count = quad_count(*task.reference);
  for (const auto& image : task.neighbors) count += quad_count(*image);
  return count;
}

std::vector<PlaneNeighbor> make_neighbors(const SweepTask& task) {
  std::vector<PlaneNeighbor> neighbors;
  std::uint64_t first_texel = quad_count(*task.reference);
  for (std::size_t i = 0; i < task.neighbors.size(); ++i) {
    const PaddedImage& image = *task.neighbors[i];
    neighbors.push_back({task.warps[i], image.width, image.height, static_cast<int>(first_texel), 0});
    first_texel += quad_count(image);
  }
  return neighbors;
}

std::vector<PlanePixel> make_pixels(const SweepTask& task) {
  const Grid<SupportWindow> windows =
      make_support_windows(*task.reference, task.options.window, task.options.support_tolerance);
  const Grid<InverseDepthRange> ranges = inverse_depth_ranges(task);
  std::vector<PlanePixel> pixels;
  pixels.reserve(ranges.values.size());
  for (std::size_t i = 0; i < ranges.values.size(); ++i) pixels.push_back({windows.values[i], ranges.values[i]});
  return pixels;
}

/// The planes that the pixels begin with.
std::vector<PlaneTexel> first_texels(const SweepTask& task, const Grid<PixelVote>& first_pass) {
  std::vector<PlaneTexel> planes;
  planes.reserve(first_pass.values.size());
  for (const PlaneTrial& trial : first_planes(task, first_pass).values)
    planes.push_back({trial.inverse_depth, trial.slope_x, trial.slope_y, -1.0F});
  return planes;
}

/// Rows that an invocation takes: as many as its loops may go around for, all lanes of a vector one after the other.
std::int64_t rows_per_lane(const SweepTask& task, std::int64_t moves, std::uint32_t max_loop_iterations) {
  const std::int64_t windows = moves * task.neighbor_count();
  const std::int64_t iterations = windows * (1 + task.options.window) + kLanes * (moves + 2);
  return std::clamp<std::int64_t>(std::int64_t{max_loop_iterations} / iterations, 1, kRowsPerLane);
}

}  // namespace

bool PlaneLanesStage::fits(const SweepTask& task) const {
  const DeviceInfo& info = commands_->device().info();
  const std::uint64_t pixels = quad_count(*task.reference) * (sizeof(PlanePixel) / sizeof(Texel));
  const std::uint64_t texels = std::max(all_quads(task), pixels);
  return texels <= info.max_texel_buffer_elements && texels <= info.max_allocation / sizeof(Texel);
}

Buffer PlaneLanesStage::upload_images(const SweepTask& task) const {
  Buffer quads = commands_->allocate(sizeof(Texel) * all_quads(task), BufferUse::kInParts);
  commands_->upload(make_quads(*task.reference), quads, 0);
  std::uint64_t offset = quads_size(*task.reference);
  for (const auto& image : task.neighbors) {
    commands_->upload(make_quads(*image), quads, offset);
    offset += quads_size(*image);
  }
  return quads;
}

PlaneLanesStage::Buffers PlaneLanesStage::upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const {
  const std::size_t pixels = first_pass.values.size();
  return {.neighbors = commands_->upload(make_neighbors(task)),
          .pixels = commands_->upload(make_pixels(task), BufferUse::kInParts),
          .quads = upload_images(task),
          .last = commands_->upload(first_texels(task, first_pass), BufferUse::kInParts),
          .planes = commands_->allocate(sizeof(PlaneTexel) * pixels, BufferUse::kInParts),
          .correlations = commands_->allocate_zeros(sizeof(float) * pixels, BufferUse::kInParts)};
}

Expected<void> PlaneLanesStage::run_round(const SweepTask& task, Buffers& buffers, const std::vector<PlaneMove>& moves,
                                          bool is_first) {
  const DeviceInfo& info = commands_->device().info();
  const Buffer move_buffer = commands_->upload(moves);
  const VoteRule rule = make_vote_rule(task.options, task.neighbor_count());
  const auto move_count = static_cast<std::int64_t>(moves.size());
  const std::int64_t width = task.ranges.width;
  const std::int64_t height = task.ranges.height;
  const std::int64_t most_rows = rows_per_lane(task, move_count, info.max_loop_iterations);
  const auto most_planes = static_cast<std::int64_t>(info.max_storage_buffer_range / sizeof(PlaneTexel));
  const std::int64_t run_pixels =
      std::min(kSamplesOfRun / (move_count * task.neighbor_count() * task.options.window * task.options.window),
               most_planes - kViewMultiple);
  const std::int64_t run_rows = std::max<std::int64_t>(1, run_pixels / width);
  commands_->region("refine_planes");
  for (std::int64_t begin = 0; begin < height; begin += run_rows) {
    const std::int64_t end = std::min(begin + run_rows, height);
    const std::int64_t rows = std::min(most_rows, end - begin);
    const std::int64_t first_pixel = begin * width / kViewMultiple * kViewMultiple;
    const RefinePlanesLanesParams params{.width = task.ranges.width,
                                         .height = task.ranges.height,
                                         .row_begin = static_cast<int>(begin),
                                         .row_end = static_cast<int>(end),
                                         .rows_per_lane = static_cast<int>(rows),
                                         .first_pixel = static_cast<int>(first_pixel),
                                         .move_count = static_cast<int>(move_count),
                                         .neighbor_count = task.neighbor_count(),
                                         .is_first = is_first ? 1 : 0,
                                         .min_votes = rule.min_votes,
                                         .max_tilt = task.max_tilt,
                                         .threshold = rule.threshold,
                                         .confidence_scale = rule.confidence_scale};
    const auto run_of = [&](const Buffer& buffer, std::size_t pixel_bytes) {
      return BufferView(buffer, pixel_bytes * static_cast<std::uint64_t>(first_pixel),
                        pixel_bytes * static_cast<std::uint64_t>(end * width - first_pixel));
    };
    const std::int64_t groups = ((width + kLanes - 1) / kLanes) * ((end - begin + rows - 1) / rows);
    commands_->dispatch(kernels_.at(task.options.window), {groups * kLanes}, params,
                        {move_buffer, buffers.neighbors, buffers.pixels, buffers.quads, buffers.last,
                         run_of(buffers.planes, sizeof(PlaneTexel)), run_of(buffers.correlations, sizeof(float))});
    QUORUM_TRY(commands_->submit());
  }
  std::swap(buffers.last, buffers.planes);
  return {};
}

Expected<Grid<PixelPlane>> PlaneLanesStage::run(const SweepTask& task, const Grid<PixelVote>& first_pass) {
  Buffers buffers = upload(task, first_pass);
  QUORUM_TRY(run_round(task, buffers, {PlaneMove{}}, true));
  for (const std::vector<PlaneMove>& round : plane_rounds(task.planes, task.options.window))
    QUORUM_TRY(run_round(task, buffers, round, false));
  std::vector<PlaneTexel> planes(first_pass.values.size());
  QUORUM_TRY(commands_->download(buffers.last, planes));
  std::vector<float> correlations(first_pass.values.size());
  QUORUM_TRY(commands_->download(buffers.correlations, correlations));
  Grid<PixelPlane> best(first_pass.width, first_pass.height, kNoPlane);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneTexel& plane = planes[i];
    best.values[i] = {
        plane.inverse_depth, plane.slope_x, plane.slope_y, correlations[i], std::abs(plane.confidence), 0};
  }
  return best;
}

}  // namespace quorum
