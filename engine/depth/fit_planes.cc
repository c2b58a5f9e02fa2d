#include "engine/depth/fit_planes.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "engine/core/exact.h"
#include "engine/core/simd.h"

namespace quorum {
namespace {

constexpr int kReach = 3;        // pixels on each side
constexpr int kLeastDepths = 6;  // for slopes

/// Moments of the offsets of pixels and of their inverse depths w against that of the center.
struct Moments {
  int n = 0;
  int x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  float w = 0.0F, xw = 0.0F, yw = 0.0F;

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

constexpr int kPixels = 64;  // of a row, side by side

template <typename T>
using FitLanes = std::array<T, kPixels>;

/// The moments of pixels side by side, and the row that is added.
struct MomentLanes {
  FitLanes<float> here;                           ///< inverse depths of the pixels; 0 = none
  std::array<float, kPixels + 2 * kReach> other;  ///< of the row, from kReach pixels before the first
  FitLanes<std::int32_t> n, x, y, xx, xy, yy;
  FitLanes<float> w, xw, yw;

  void clear() {
    for (auto* sums : {&n, &x, &y, &xx, &xy, &yy}) sums->fill(0);
    for (auto* sums : {&w, &xw, &yw}) sums->fill(0.0F);
  }
  [[nodiscard]] Moments at(std::size_t i) const { return {n[i], x[i], y[i], xx[i], xy[i], yy[i], w[i], xw[i], yw[i]}; }
};

/// Adds a row, dy pixels below the pixels' own: of each pixel those at most kReach away that lie within the limit.
[[gnu::always_inline]] inline void add_row(int dy, float limit, MomentLanes& lanes) {
  for (int dx = -kReach; dx <= kReach; ++dx) {
    for (int i = 0; i < kPixels; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const float other = lanes.other[static_cast<std::size_t>(i + dx + kReach)];
      const float apart = other - lanes.here[k];
      const bool adds = (other != 0.0F) & (apart >= -limit) & (apart <= limit);
      const float difference = kept_if(adds, apart);
      const std::int32_t one = static_cast<std::int32_t>(adds);
      lanes.n[k] += one;
      lanes.x[k] += dx * one;
      lanes.y[k] += dy * one;
      lanes.xx[k] += dx * dx * one;
      lanes.xy[k] += dx * dy * one;
      lanes.yy[k] += dy * dy * one;
      lanes.w[k] += difference;
      lanes.xw[k] += static_cast<float>(dx) * difference;
      lanes.yw[k] += static_cast<float>(dy) * difference;
    }
  }
}

/// Copies a row from pixel x on, 0 beyond its ends.
template <std::size_t kCount>
void copy_row(const Grid<float>& grid, int x, int y, std::array<float, kCount>& to) {
  to.fill(0.0F);
  const int begin = std::max(x, 0);
  const int end = std::min(x + static_cast<int>(kCount), grid.width);
  if (begin < end) std::copy(grid.row(y) + begin, grid.row(y) + end, to.begin() + (begin - x));
}

/// Inverse depths of the votes' planes; 0 where there is none.
Grid<float> inverse_depths_of(const Grid<PixelVote>& votes, const DepthPlanes& planes) {
  Grid<float> result(votes.width, votes.height);
  tbb::parallel_for(std::size_t{0}, votes.values.size(), [&](std::size_t pixel) {
    const int plane = votes.values[pixel].plane;
    if (plane >= 0) result.values[pixel] = planes.inverse_depth[static_cast<std::size_t>(plane)];
  });
  return result;
}

}  // namespace

float fit_limit(const DepthPlanes& planes) {
  constexpr float kSteps = 3.0F;
  return kSteps * planes.step();
}

Grid<PlaneTrial> fit_planes(const Grid<PixelVote>& votes, const DepthPlanes& planes, SimdLevel simd) {
  const float limit = fit_limit(planes);
  const Grid<float> inverse_depth = inverse_depths_of(votes, planes);
  const auto add = simd_form<add_row>(simd);
  Grid<PlaneTrial> fitted(votes.width, votes.height, PlaneTrial{});
  tbb::parallel_for(0, votes.height, [&](int y) {
    thread_local const auto lanes = std::make_unique<MomentLanes>();
    for (int x = 0; x < votes.width; x += kPixels) {
      copy_row(inverse_depth, x, y, lanes->here);
      if (std::ranges::all_of(lanes->here, [](float here) { return here == 0.0F; })) continue;
      lanes->clear();
      for (int dy = std::max(-kReach, -y); dy <= std::min(kReach, votes.height - 1 - y); ++dy) {
        copy_row(inverse_depth, x - kReach, y + dy, lanes->other);
        add(dy, limit, *lanes);
      }
      for (int i = 0; i < std::min(kPixels, votes.width - x); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (lanes->here[k] != 0.0F) fitted.at(x + i, y) = lanes->at(k).plane(lanes->here[k]);
      }
    }
  });
  return fitted;
}

}  // namespace quorum
