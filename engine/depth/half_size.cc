#include "engine/depth/half_size.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/depth/small_task.h"

namespace quorum {
namespace {

/// Every second plane of the first pass, and the last.
DepthPlanes half_planes(const DepthPlanes& planes) {
  DepthPlanes half;
  const auto add = [&](std::size_t plane) {
    half.depth.push_back(planes.depth[plane]);
    half.inverse_depth.push_back(planes.inverse_depth[plane]);
  };
  const std::size_t stride = 2 * static_cast<std::size_t>(planes.refinement);
  const std::size_t last = planes.depth.size() - 1;
  for (std::size_t plane = 0; plane < last; plane += stride) add(plane);
  add(last);
  return half;
}

/// Half pixels with a pixel that is swept and has no depth.
Grid<std::uint8_t> missing_pixels(const SweepTask& task, const DepthMap& full, int width, int height) {
  Grid<std::uint8_t> missing(width, height);
  tbb::parallel_for(0, height, [&](int row) {
    for (const int y : {2 * row, 2 * row + 1})
      for (int x = 0; x < 2 * width; ++x)
        if (full.depth.at(x, y) == 0.0F && task.ranges.at(x, y).first <= task.ranges.at(x, y).last)
          missing.at(x / 2, row) = 1;
  });
  return missing;
}

/// Pixels at most reach away, in a square, from one that is set.
Grid<std::uint8_t> grown(const Grid<std::uint8_t>& pixels, int reach) {
  Grid<std::uint8_t> rows(pixels.width, pixels.height);
  Grid<std::uint8_t> all(pixels.width, pixels.height);
  tbb::parallel_for(0, pixels.height, [&](int y) {
    for (int x = 0; x < pixels.width; ++x)
      if (pixels.at(x, y) != 0)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, pixels.width - 1); ++u) rows.at(u, y) = 1;
  });
  tbb::parallel_for(0, pixels.height, [&](int y) {
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, pixels.height - 1); ++v)
      for (int x = 0; x < pixels.width; ++x) all.at(x, y) |= rows.at(x, v);
  });
  return all;
}

/// The planes of the half size that hold one of the pixels' own; empty where none does.
PlaneRange half_range(const SweepTask& task, int x, int y, uint last_plane) {
  const auto stride = 2 * static_cast<uint>(task.planes.refinement);
  PlaneRange range{1, 0};
  for (const int v : {2 * y, 2 * y + 1}) {
    for (const int u : {2 * x, 2 * x + 1}) {
      const PlaneRange& own = task.ranges.at(u, v);
      if (own.first > own.last) continue;
      const PlaneRange wide{own.first / stride, std::min((own.last + stride - 1) / stride, last_plane)};
      range = range.first > range.last ? wide
                                       : PlaneRange{std::min(range.first, wide.first), std::max(range.last, wide.last)};
    }
  }
  return range;
}

/// Whether the depths around a pixel of the half size go on as its own.
bool is_inside_patch(const DepthMap& coarse, int x, int y, float most_difference) {
  constexpr int kMargin = 2;
  if (x < kMargin || y < kMargin || x >= coarse.depth.width - kMargin || y >= coarse.depth.height - kMargin)
    return false;
  const float own = 1.0F / coarse.depth.at(x, y);
  for (int v = y - kMargin; v <= y + kMargin; ++v) {
    for (int u = x - kMargin; u <= x + kMargin; ++u) {
      const float depth = coarse.depth.at(u, v);
      if (depth == 0.0F || std::abs(1.0F / depth - own) > most_difference) return false;
    }
  }
  return true;
}

}  // namespace

SweepTask make_half_task(const SweepTask& task, const DepthMap& full, const View& reference,
                         const std::vector<const View*>& neighbors, SmallImages& images) {
  constexpr int kGrown = 3;  // pixels of half size: what lies around makes planes and patches whole
  SweepTask half = make_small_task(task, reference, neighbors, 1, images);
  half.options.refinement = 1;
  half.outside = task.outside;
  half.outside_halvings = task.outside_halvings - 1;
  half.planes = half_planes(task.planes);
  const int width = half.reference->width;
  const int height = half.reference->height;
  const int radius = half.options.window / 2;
  const Grid<std::uint8_t> wanted = grown(missing_pixels(task, full, width, height), kGrown);
  const auto last_plane = static_cast<uint>(half.planes.depth.size() - 1);
  half.ranges = Grid<PlaneRange>(width, height, PlaneRange{1, 0});
  tbb::parallel_for(radius, std::max(height - radius, radius), [&](int y) {
    for (int x = radius; x < width - radius; ++x)
      if (wanted.at(x, y) != 0) half.ranges.at(x, y) = half_range(task, x, y, last_plane);
  });
  return half;
}

void take_from_half(const SweepTask& task, const SweepTask& half, const DepthMap& coarse, DepthMap& map) {
  constexpr float kShareOfConfidence = 0.25F;
  const float most_difference = 4.0F * half.planes.step();
  const Eigen::Matrix3d rays = task.intrinsics.inverse();
  const Eigen::Matrix3d half_rays = half.intrinsics.inverse();
  tbb::parallel_for(0, coarse.depth.height, [&](int y) {
    for (int x = 0; x < coarse.depth.width; ++x) {
      if (coarse.depth.at(x, y) == 0.0F || !is_inside_patch(coarse, x, y, most_difference)) continue;
      const Eigen::Vector3d normal = coarse.normal.at(x, y).cast<double>();
      const double offset =
          normal.dot(half_rays * Eigen::Vector3d(x, y, 1.0)) * static_cast<double>(coarse.depth.at(x, y));
      for (const int v : {2 * y, 2 * y + 1}) {
        for (const int u : {2 * x, 2 * x + 1}) {
          const PlaneRange& range = task.ranges.at(u, v);
          if (map.depth.at(u, v) != 0.0F || range.first > range.last) continue;
          const double depth = offset / normal.dot(rays * Eigen::Vector3d(u, v, 1.0));
          if (!(depth >= task.planes.depth[range.first] && depth <= task.planes.depth[range.last])) continue;
          map.depth.at(u, v) = static_cast<float>(depth);
          map.correlation.at(u, v) = coarse.correlation.at(x, y);
          map.confidence.at(u, v) = kShareOfConfidence * coarse.confidence.at(x, y);
          map.normal.at(u, v) = coarse.normal.at(x, y);
        }
      }
    }
  });
}

}  // namespace quorum
