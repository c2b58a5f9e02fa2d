#include "engine/depth/refine_planes.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "engine/core/clock.h"
#include "engine/depth/first_planes.h"
#include "engine/depth/propose_planes.h"
#include "engine/depth/score_planes.h"
#include "engine/depth/support_windows.h"
#include "engine/depth/sweep_tile.h"

namespace quorum {
namespace {

/// The planes of a view while they are refined.
struct Refinement {
  const SweepTask& task;
  PlaneScorer scorer;
  Grid<InverseDepthRange> ranges;
  PlaneGrid last;           ///< of the last round
  PlaneGrid best;           ///< so far
  Grid<float> correlation;  ///< of the best ones, as what follows
  Grid<float> confidence;
  std::atomic<std::uint64_t> trials = 0;
  std::atomic<std::uint64_t> samples = 0;

  [[nodiscard]] PixelPlane plane(std::size_t pixel) const {
    return {best.inverse_depth.values[pixel], best.slope_x.values[pixel], best.slope_y.values[pixel],
            correlation.values[pixel],        confidence.values[pixel],   best.taken_by.values[pixel]};
  }
  void take(int x, int y, const PixelPlane& plane) {
    best.inverse_depth.at(x, y) = plane.inverse_depth;
    best.slope_x.at(x, y) = plane.slope_x;
    best.slope_y.at(x, y) = plane.slope_y;
    best.taken_by.at(x, y) = plane.taken_by;
    correlation.at(x, y) = plane.correlation;
    confidence.at(x, y) = plane.confidence;
  }
};

/// Scores a batch that the move with this number made, and takes the winners.
void take_winners(const TileSupports& supports, int move, PlaneBatch& batch, Refinement& refinement) {
  std::uint64_t samples = 0;
  refinement.trials += static_cast<std::uint64_t>(batch.count);
  score_planes(refinement.scorer, supports, batch, samples);
  refinement.samples += samples;
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
    const PlaneTrial trial{batch.inverse_depth[i], batch.slope_x[i], batch.slope_y[i], batch.ncc_sum[i],
                           batch.votes[i]};
    refinement.take(batch.x[i], batch.y[i], taken_plane(trial, refinement.scorer.rule, move));
  }
  batch.count = 0;
}

/// Tries the planes that propose(x, y, count) gives to pixels of a tile, some of a row at a time. move: its
/// number.
template <typename Propose>
void try_planes(const Tile& tile, const TileSupports& supports, int move, const Propose& propose,
                Refinement& refinement) {
  thread_local const auto batch = std::make_unique<PlaneBatch>();
  for (int y = tile.y; y < tile.y_end; ++y) {
    for (int x = tile.x; x < tile.x_end; x += PlaneProposals::kCapacity) {
      const int count = std::min(tile.x_end - x, PlaneProposals::kCapacity);
      const PlaneProposals& proposals = propose(x, y, count);
      const float* confidence = refinement.confidence.row(y) + x;
      for (int i = 0; i < count; ++i) {
        const auto place = static_cast<std::size_t>(i);
        if (proposals.may_take[place] == 0) continue;
        batch->add(x + i, y,
                   {proposals.inverse_depth[place], proposals.slope_x[place], proposals.slope_y[place], 0.0F, 0},
                   confidence[i]);
        if (batch->full()) take_winners(supports, move, *batch, refinement);
      }
    }
  }
  take_winners(supports, move, *batch, refinement);
}

bool has_rays(const Refinement& refinement, const Tile& tile) {
  for (int y = tile.y; y < tile.y_end; ++y)
    for (int x = tile.x; x < tile.x_end; ++x)
      if (const InverseDepthRange& range = refinement.ranges.at(x, y); range.farthest <= range.nearest) return true;
  return false;
}

/// work(tile, supports) for all tiles in which planes may be tried.
template <typename Work>
void for_each_tile(const Refinement& refinement, const CpuSweepOptions& cpu, const Work& work) {
  const int width = refinement.ranges.width;
  const int height = refinement.ranges.height;
  const int columns = (width + cpu.tile_width - 1) / cpu.tile_width;
  const int rows = (height + cpu.tile_height - 1) / cpu.tile_height;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1), [&](const auto& part) {
    thread_local TileSupports supports;
    for (int row = part.rows().begin(); row < part.rows().end(); ++row) {
      for (int column = part.cols().begin(); column < part.cols().end(); ++column) {
        const Tile tile{column * cpu.tile_width, row * cpu.tile_height, std::min((column + 1) * cpu.tile_width, width),
                        std::min((row + 1) * cpu.tile_height, height)};
        if (!has_rays(refinement, tile)) continue;
        supports.pack(refinement.task, refinement.scorer.windows, tile, cpu.simd);
        work(tile, supports);
      }
    }
  });
}

/// The plane b u + c v + e of inverse depth over pixels (u, v, 1) is K^-T n / d of the plane n · p = d, and lies before
/// the camera, so K^T (b, c, e) points away from it.
Eigen::Vector3f plane_normal(const PixelPlane& plane, double x, double y, const Eigen::Matrix3d& intrinsics) {
  const double b = plane.slope_x;
  const double c = plane.slope_y;
  const double e = static_cast<double>(plane.inverse_depth) - b * x - c * y;
  const double normal_x = intrinsics(0, 0) * b;
  const double normal_y = intrinsics(0, 1) * b + intrinsics(1, 1) * c;
  const double normal_z = intrinsics(0, 2) * b + intrinsics(1, 2) * c + e;
  const double scale = -1.0 / std::sqrt(normal_x * normal_x + normal_y * normal_y + normal_z * normal_z);
  return {static_cast<float>(normal_x * scale), static_cast<float>(normal_y * scale),
          static_cast<float>(normal_z * scale)};
}

void end_round(Refinement& refinement) {
  const auto width = static_cast<std::size_t>(refinement.ranges.width);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(refinement.ranges.height), [&](std::size_t row) {
    const auto copy = [&](const auto& from, auto& to) {
      std::copy_n(from.values.begin() + static_cast<std::ptrdiff_t>(row * width), width,
                  to.values.begin() + static_cast<std::ptrdiff_t>(row * width));
    };
    copy(refinement.best.inverse_depth, refinement.last.inverse_depth);
    copy(refinement.best.slope_x, refinement.last.slope_x);
    copy(refinement.best.slope_y, refinement.last.slope_y);
    copy(refinement.best.taken_by, refinement.last.taken_by);
    std::fill_n(refinement.best.taken_by.values.begin() + static_cast<std::ptrdiff_t>(row * width), width, 0);
  });
}

/// The planes to begin with, as far as the pixels may take them. Until this thread's next call.
const PlaneProposals& propose_first(const Grid<PlaneTrial>& fitted, const Refinement& refinement, int x, int y,
                                    int count) {
  thread_local PlaneProposals proposals;
  for (int i = 0; i < count; ++i) {
    const PlaneTrial& plane = fitted.at(x + i, y);
    const auto place = static_cast<std::size_t>(i);
    proposals.inverse_depth[place] = plane.inverse_depth;
    proposals.slope_x[place] = plane.slope_x;
    proposals.slope_y[place] = plane.slope_y;
    proposals.may_take[place] = static_cast<std::int32_t>(
        plane.inverse_depth != 0.0F && may_take(plane, refinement.ranges.at(x + i, y), refinement.task.max_tilt));
  }
  return proposals;
}

}  // namespace

Grid<PixelPlane> refine_planes(const SweepTask& task, const Grid<PixelVote>& first_pass, const CpuSweepOptions& cpu,
                               PassWork* work) {
  const double cpu_start = foreground_cpu_seconds();
  const int width = first_pass.width;
  const int height = first_pass.height;
  const Grid<SupportWindow> windows =
      make_support_windows(*task.reference, task.options.window, task.options.support_tolerance, cpu.simd);
  Refinement refinement{task,
                        make_plane_scorer(task, windows, cpu.simd),
                        inverse_depth_ranges(task),
                        PlaneGrid(width, height),
                        PlaneGrid(width, height),
                        Grid<float>(width, height),
                        Grid<float>(width, height)};
  const Grid<PlaneTrial> fitted = first_planes(task, first_pass, cpu.simd);
  for_each_tile(refinement, cpu, [&](const Tile& tile, const TileSupports& supports) {
    const auto propose = [&](int x, int y, int count) -> const PlaneProposals& {
      return propose_first(fitted, refinement, x, y, count);
    };
    try_planes(tile, supports, 1, propose, refinement);
  });
  end_round(refinement);
  for (const std::vector<PlaneMove>& round : plane_rounds(task.planes, task.options.window)) {
    for_each_tile(refinement, cpu, [&](const Tile& tile, const TileSupports& supports) {
      int number = 0;
      for (const PlaneMove& move : round) {
        const auto propose = [&](int x, int y, int count) -> const PlaneProposals& {
          return propose_planes(move, refinement.last, refinement.best, refinement.ranges, task.max_tilt, x, y, count,
                                cpu.simd);
        };
        try_planes(tile, supports, ++number, propose, refinement);
      }
    });
    end_round(refinement);
  }
  if (work != nullptr) {
    work->windows += refinement.trials * static_cast<std::uint64_t>(task.neighbor_count());
    work->samples += refinement.samples;
    work->cpu_seconds += foreground_cpu_seconds() - cpu_start;
  }
  Grid<PixelPlane> planes(width, height, kNoPlane);
  tbb::parallel_for(std::size_t{0}, planes.values.size(),
                    [&](std::size_t pixel) { planes.values[pixel] = refinement.plane(pixel); });
  return planes;
}

DepthMap depth_map_from_planes(const Grid<PixelPlane>& planes, const SweepTask& task) {
  DepthMap map{Grid<float>(planes.width, planes.height), Grid<float>(planes.width, planes.height),
               Grid<float>(planes.width, planes.height),
               Grid<Eigen::Vector3f>(planes.width, planes.height, Eigen::Vector3f::Zero())};
  tbb::parallel_for(std::size_t{0}, planes.values.size(), [&](std::size_t pixel) {
    const PixelPlane& plane = planes.values[pixel];
    if (plane.inverse_depth == 0.0F) return;
    if (plane.inverse_depth < task.planes.inverse_depth[task.ranges.values[pixel].last]) return;  // beyond the bounds
    map.depth.values[pixel] = reciprocal(plane.inverse_depth);
    map.correlation.values[pixel] = plane.correlation;
    map.confidence.values[pixel] = std::min(plane.confidence, 1.0F);
    const auto width = static_cast<std::size_t>(planes.width);
    map.normal.values[pixel] =
        plane_normal(plane, static_cast<double>(pixel % width), static_cast<double>(pixel / width), task.intrinsics);
  });
  return map;
}

}  // namespace quorum
