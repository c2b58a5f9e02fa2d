#include "engine/depth/sweep_depth.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "engine/core/check.h"
#include "engine/core/clock.h"
#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/project.h"
#include "engine/depth/reference_windows.h"
#include "engine/depth/refine_depth.h"
#include "engine/depth/refine_planes.h"
#include "engine/depth/sweep_tile.h"
#include "engine/depth/vote_depth.h"

namespace quorum {

float window_ncc(const SweepTask& task, int neighbor, int x, int y, int plane) {
  const PaddedImage& image = *task.neighbors[static_cast<std::size_t>(neighbor)];
  const PlaneWarp& warp = task.warps[static_cast<std::size_t>(neighbor)];
  const float inverse_depth = task.planes.inverse_depth[static_cast<std::size_t>(plane)];
  const int radius = task.options.window / 2;
  const int extra_shift = extra_sample_shift(task.options.window);
  const bool axis = task.options.is_along_axes();
  const Projection center = project(warp, x, y, inverse_depth, image.width, image.height, 0);

  const auto position = [&](int dx, int dy) {
    if (!axis) return project(warp, x + dx, y + dy, inverse_depth, image.width, image.height, 0);
    const int u = center.u + dx * kPositionScale;
    const int v = center.v + dy * kPositionScale;
    const bool inside = center.inside && u >= 0 && v >= 0 && u <= (image.width - 1) * kPositionScale &&
                        v <= (image.height - 1) * kPositionScale;
    return inside ? Projection{u, v, 1} : Projection{};
  };
  // A plane maps the window to a convex quadrilateral, so the corners decide for all of it. A sample that rounding puts
  // 1/256 pixel outside all the same is read at the image's first pixel, on every device.
  for (const int dy : {-radius, radius})
    for (const int dx : {-radius, radius})
      if (!position(dx, dy).inside) return kNoNcc;

  ReferenceSums reference;
  WindowSums sums;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Projection at = position(dx, dy);
      const Sample a = sample_pixel(task.reference->at(x + dx, y + dy), kSampleShift + extra_shift);
      add_sample(reference, a);
      add_sample(sums, a, sample_bilinear(image, at.u, at.v, extra_shift));
    }
  }
  const int samples = task.options.window * task.options.window;
  return ncc_from_sums(window_from_sums(reference, samples), sums, samples);
}

Grid<PixelVote> sweep_planes(const SweepTask& task, const Grid<PlaneRange>& ranges, int stride,
                             const CpuSweepOptions& cpu, PassWork* work) {
  QUORUM_CHECK_EQ(ranges.width, task.reference->width);
  const double cpu_start = foreground_cpu_seconds();
  const TileSweep sweep = make_tile_sweep(task, cpu.simd);
  const int window = task.options.window;
  std::atomic<std::uint64_t> tests = 0;
  std::atomic<std::uint64_t> samples = 0;
  Grid<PixelVote> votes(ranges.width, ranges.height, kNoVote);
  const int columns = (ranges.width + cpu.tile_width - 1) / cpu.tile_width;
  const int rows = (ranges.height + cpu.tile_height - 1) / cpu.tile_height;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1), [&](const auto& part) {
    TilePlanes tile_planes;
    for (int row = part.rows().begin(); row < part.rows().end(); ++row) {
      for (int column = part.cols().begin(); column < part.cols().end(); ++column) {
        const Tile tile{column * cpu.tile_width, row * cpu.tile_height,
                        std::min((column + 1) * cpu.tile_width, ranges.width),
                        std::min((row + 1) * cpu.tile_height, ranges.height)};
        tile_planes.collect(ranges, tile, stride, window);
        if (tile_planes.planes().empty()) continue;
        sweep_tile(sweep, ranges, tile, tile_planes.planes(), votes);
        const bool shared = !task.options.is_along_axes();
        tests += tile_planes.tests();
        samples += shared ? tile_planes.samples(window) : tile_planes.tests() * static_cast<uint>(window * window);
      }
    }
  });
  if (work != nullptr) {
    const auto neighbors = static_cast<std::uint64_t>(task.neighbor_count());
    work->windows += tests * neighbors;
    work->samples += samples * neighbors;
    work->cpu_seconds += foreground_cpu_seconds() - cpu_start;
  }
  return votes;
}

DepthMap sweep_depth(const SweepTask& task, const CpuSweepOptions& cpu, SweepWork* work) {
  SweepWork done;
  Grid<PixelVote> votes = sweep_planes(task, task.ranges, task.planes.refinement, cpu, &done.sweep);
  if (task.options.is_slanted()) {
    const Grid<PixelPlane> planes = refine_planes(task, votes, cpu, &done.refine);
    if (work != nullptr) *work = done;
    return depth_map_from_planes(planes, task);
  }
  if (task.planes.refinement > 1) votes = sweep_planes(task, refine_ranges(votes, task.planes), 1, cpu, &done.refine);
  if (work != nullptr) *work = done;
  return depth_map_from_votes(votes, task.planes);
}

}  // namespace quorum
