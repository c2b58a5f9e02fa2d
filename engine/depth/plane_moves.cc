#include "engine/depth/plane_moves.h"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace quorum {

std::vector<std::vector<PlaneMove>> plane_rounds(const DepthPlanes& planes, int window) {
  constexpr int kRounds = 3;
  constexpr std::array<int, kRounds> kFar = {8, 5, 3};
  std::vector<std::vector<PlaneMove>> rounds;
  for (int round = 0; round < kRounds; ++round) {
    const float depth = std::ldexp(planes.step(), -1 - round);
    const float slope = 2.0F * depth / static_cast<float>(window);
    std::vector<PlaneMove> moves;
    for (const int distance : {1, kFar[static_cast<std::size_t>(round)]})
      for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        moves.push_back({distance * x, distance * y, 0.0F, 0.0F, 0.0F, depth, slope, 0});
    for (const auto& [w, x, y] : {std::tuple{depth, 0.0F, 0.0F}, {0.0F, slope, 0.0F}, {0.0F, 0.0F, slope}}) {
      moves.push_back({0, 0, w, x, y, 0.0F, 0.0F, 0});
      const int there = static_cast<int>(moves.size());
      moves.push_back({0, 0, -w, -x, -y, 0.0F, 0.0F, there});
    }
    rounds.push_back(std::move(moves));
  }
  return rounds;
}

Grid<InverseDepthRange> inverse_depth_ranges(const SweepTask& task) {
  const std::vector<float>& inverse_depth = task.planes.inverse_depth;
  const bool ends = task.outside.values.empty();
  Grid<InverseDepthRange> result(task.ranges.width, task.ranges.height, {1.0F, 0.0F});
  tbb::parallel_for(std::size_t{0}, task.ranges.values.size(), [&](std::size_t pixel) {
    const PlaneRange& range = task.ranges.values[pixel];
    if (range.first <= range.last)
      result.values[pixel] = {ends ? inverse_depth[range.last] : 0.0F, inverse_depth[range.first]};
  });
  return result;
}

float max_plane_tilt(const Camera& camera) {
  constexpr double kMaxTiltDeg = 80.0;
  const double focal = (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)) / 2.0;
  return static_cast<float>(std::tan(kMaxTiltDeg * std::numbers::pi / 180.0) / focal);
}

}  // namespace quorum
