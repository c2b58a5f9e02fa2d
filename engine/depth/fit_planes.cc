#include "engine/depth/fit_planes.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "engine/core/exact.h"

namespace quorum {
namespace {

constexpr int kReach = 3;        // pixels on each side
constexpr int kLeastDepths = 6;  // for slopes

/// Moments of the offsets of pixels and of their inverse depths w against that of the center.
struct Moments {
  int n = 0;
  int x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  float w = 0.0F, xw = 0.0F, yw = 0.0F;

  void add(int dx, int dy, float difference) {
    ++n;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    w += difference;
    xw += static_cast<float>(dx) * difference;
    yw += static_cast<float>(dy) * difference;
  }

  /// Of a pixel whose own inverse depth is given.
  [[nodiscard]] PlaneTrial plane(float inverse_depth) const {
    // The normal equations with the mean taken off, times n: [a b; b c] · slopes = (d, e).
    const int a = n * xx - x * x;
    const int b = n * xy - x * y;
    const int c = n * yy - y * y;
    const int determinant = a * c - b * b;
    if (n < kLeastDepths || determinant <= 0) return {inverse_depth, 0.0F, 0.0F, 0.0F, 0};
    const auto real = [](int value) { return static_cast<float>(value); };
    const float d = real(n) * xw - real(x) * w;
    const float e = real(n) * yw - real(y) * w;
    const float scale = reciprocal(real(determinant));
    const float slope_x = (real(c) * d - real(b) * e) * scale;
    const float slope_y = (real(a) * e - real(b) * d) * scale;
    const float mean = (w - (slope_x * real(x) + slope_y * real(y))) * reciprocal(real(n));
    return {inverse_depth + mean, slope_x, slope_y, 0.0F, 0};
  }
};

}  // namespace

float fit_limit(const DepthPlanes& planes) {
  constexpr float kSteps = 3.0F;
  return kSteps * planes.step();
}

Grid<PlaneTrial> fit_planes(const Grid<PixelVote>& votes, const DepthPlanes& planes) {
  const auto inverse_depth = [&](int plane) { return planes.inverse_depth[static_cast<std::size_t>(plane)]; };
  const float limit = fit_limit(planes);
  Grid<PlaneTrial> fitted(votes.width, votes.height, PlaneTrial{});
  tbb::parallel_for(0, votes.height, [&](int y) {
    for (int x = 0; x < votes.width; ++x) {
      const int plane = votes.at(x, y).plane;
      if (plane < 0) continue;
      const float here = inverse_depth(plane);
      Moments moments;
      for (int dy = std::max(-kReach, -y); dy <= std::min(kReach, votes.height - 1 - y); ++dy) {
        for (int dx = std::max(-kReach, -x); dx <= std::min(kReach, votes.width - 1 - x); ++dx) {
          const int other = votes.at(x + dx, y + dy).plane;
          if (other < 0) continue;
          const float difference = inverse_depth(other) - here;
          if (difference >= -limit && difference <= limit) moments.add(dx, dy, difference);
        }
      }
      fitted.at(x, y) = moments.plane(here);
    }
  });
  return fitted;
}

}  // namespace quorum
