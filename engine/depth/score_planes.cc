// Loops run over the planes of a batch, with arrays for what differs between them, so that the compiler vectorizes
// them; compiled for three instruction sets as the sweep is.
#include "engine/depth/score_planes.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "engine/core/check.h"
#include "engine/core/exact.h"
#include "engine/depth/plane_window.h"
#include "engine/depth/window_ncc.h"

namespace quorum {
namespace {

constexpr int kLanes = PlaneBatch::kCapacity;

template <typename T>
using Lanes = std::array<T, kLanes>;

constexpr int kMaxWindow = 15;

/// What a thread needs to score a batch.
struct Workspace {
  // Of the supports, for all neighbors.
  Lanes<std::int32_t> sum_a[3];
  Lanes<float> inverse_deviation;
  Lanes<std::int32_t> support_samples;
  std::array<Lanes<Rgba>, kMaxWindow * kMaxWindow> reference;  // texels of the windows; kBelongs: part of the support

  // Of one neighbor.
  Lanes<std::int32_t> u, v, u_x, v_x, u_y, v_y, seen;  // WindowPlacement
  Lanes<std::int32_t> fraction_x, fraction_y, texel_index;
  Lanes<std::uint64_t> top, bottom;  // two texels side by side
  Lanes<std::int32_t> sum_b[3];
  Lanes<std::int32_t> squares, products;
};

constexpr std::uint32_t kBelongs = 0x80000000U;

/// Two texels side by side, and each of them.
[[gnu::always_inline]] inline std::uint64_t texel_pair(const Rgba* left) {
  std::uint64_t pair;
  std::memcpy(&pair, left, sizeof(pair));
  return pair;
}
constexpr int kLeftShift = std::endian::native == std::endian::little ? 0 : 32;
[[gnu::always_inline]] inline Rgba left_of(std::uint64_t pair) { return static_cast<Rgba>(pair >> kLeftShift); }
[[gnu::always_inline]] inline Rgba right_of(std::uint64_t pair) { return static_cast<Rgba>(pair >> (32 - kLeftShift)); }

/// Supports of the batch: their sums, and their samples of the reference.
[[gnu::always_inline]] inline void read_supports(const PlaneScorer& scorer, const PlaneBatch& batch, int window,
                                                 int shift, Workspace& work) {
  const PaddedImage& reference = *scorer.task.reference;
  const auto lanes = static_cast<std::size_t>(batch.count);
  Lanes<std::int32_t> pixel;
  Lanes<std::int32_t> max_difference;
  for (std::size_t i = 0; i < lanes; ++i) {
    const SupportWindow& support = scorer.windows.at(batch.x[i], batch.y[i]);
    for (std::size_t channel = 0; channel < 3; ++channel) work.sum_a[channel][i] = support.sum[channel];
    work.inverse_deviation[i] = support.inverse_deviation;
    work.support_samples[i] = support.samples;
    max_difference[i] = support.max_difference;
    pixel[i] = batch.y[i] * reference.stride() + batch.x[i];
  }
  const auto sample = [shift](std::uint32_t value) { return static_cast<std::int32_t>((value << 16) >> shift); };
  const auto apart = [&](std::uint32_t a, std::uint32_t b) { return std::abs(sample(a) - sample(b)); };
  const int radius = window / 2;
  const Lanes<Rgba>& center = work.reference[static_cast<std::size_t>(window * window / 2)];
  const auto read = [&](int index) {
    const int offset = (index / window - radius) * reference.stride() + index % window - radius;
    const Rgba* pixels = reference.pixels.data();
    Lanes<Rgba>& texels = work.reference[static_cast<std::size_t>(index)];
    for (std::size_t i = 0; i < lanes; ++i) texels[i] = pixels[pixel[i] + offset];
  };
  const auto mark = [&](int index) {
    Lanes<Rgba>& texels = work.reference[static_cast<std::size_t>(index)];
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::int32_t difference = std::max(
          std::max(apart(red_of(texels[i]), red_of(center[i])), apart(green_of(texels[i]), green_of(center[i]))),
          apart(blue_of(texels[i]), blue_of(center[i])));
      const bool belongs = difference <= sample(static_cast<std::uint32_t>(max_difference[i]));
      texels[i] = (texels[i] & ~kBelongs) | (belongs ? kBelongs : 0U);
    }
  };
  for (int index = 0; index < window * window; ++index) read(index);
  for (int index = 0; index < window * window; ++index) mark(index);
}

[[gnu::always_inline]] inline void place_windows(const SweepTask& task, std::size_t neighbor, const PlaneBatch& batch,
                                                 int radius, Workspace& work) {
  const PlaneWarp warp = task.warps[neighbor];
  const int width = task.neighbors[neighbor]->width;
  const int height = task.neighbors[neighbor]->height;
  const auto lanes = static_cast<std::size_t>(batch.count);
  for (std::size_t i = 0; i < lanes; ++i) {
    const WindowPlacement at = place_window(warp, batch.x[i], batch.y[i], batch.inverse_depth[i], batch.slope_x[i],
                                            batch.slope_y[i], radius, width, height);
    const std::int32_t seen = -static_cast<std::int32_t>(at.seen);
    work.seen[i] = seen;
    work.u[i] = at.u & seen;
    work.v[i] = at.v & seen;
    work.u_x[i] = at.u_x & seen;
    work.v_x[i] = at.v_x & seen;
    work.u_y[i] = at.u_y & seen;
    work.v_y[i] = at.v_y & seen;
  }
}

/// Adds one sample of every window, or nothing where it does not belong to the support. Interpolates as
/// sample_bilinear(), red and blue in one word.
[[gnu::always_inline]] inline void add_samples(const Lanes<Rgba>& reference, std::size_t lanes, int shift,
                                               Workspace& work) {
  constexpr std::uint32_t kRedBlue = 0x00ff00ffU;
  const std::int32_t center = 1 << (23 - shift);
  for (std::size_t i = 0; i < lanes; ++i) {
    const auto fraction_x = static_cast<std::uint32_t>(work.fraction_x[i]);
    const auto fraction_y = static_cast<std::uint32_t>(work.fraction_y[i]);
    const auto along_x = [&](std::uint32_t left, std::uint32_t right) {
      return (left << 8) + (right - left) * fraction_x;
    };
    const auto along_y = [&](std::uint32_t top, std::uint32_t bottom) {
      return static_cast<std::int32_t>(((top << 8) + (bottom - top) * fraction_y) >> shift) - center;
    };
    const auto sample = [&](std::uint32_t value) { return static_cast<std::int32_t>((value << 16) >> shift) - center; };
    const Rgba top_left = left_of(work.top[i]);
    const Rgba top_right = right_of(work.top[i]);
    const Rgba bottom_left = left_of(work.bottom[i]);
    const Rgba bottom_right = right_of(work.bottom[i]);
    const std::uint32_t top = along_x(top_left & kRedBlue, top_right & kRedBlue);
    const std::uint32_t bottom = along_x(bottom_left & kRedBlue, bottom_right & kRedBlue);
    const std::uint32_t top_green = along_x(green_of(top_left), green_of(top_right));
    const std::uint32_t bottom_green = along_x(green_of(bottom_left), green_of(bottom_right));
    const std::int32_t belongs = static_cast<std::int32_t>(reference[i]) >> 31;
    const std::int32_t red = along_y(top & 0xffffU, bottom & 0xffffU) & belongs;
    const std::int32_t green = along_y(top_green, bottom_green) & belongs;
    const std::int32_t blue = along_y(top >> 16, bottom >> 16) & belongs;
    work.sum_b[0][i] += red;
    work.sum_b[1][i] += green;
    work.sum_b[2][i] += blue;
    work.squares[i] += red * red + green * green + blue * blue;
    work.products[i] += sample(red_of(reference[i])) * red + sample(green_of(reference[i])) * green +
                        sample(blue_of(reference[i])) * blue;
  }
}

[[gnu::always_inline]] inline void sum_windows(const PaddedImage& image, int count, int window, int shift,
                                               Workspace& work) {
  const auto lanes = static_cast<std::size_t>(count);
  for (auto& sums : work.sum_b) std::fill_n(sums.begin(), count, 0);
  std::fill_n(work.squares.begin(), count, 0);
  std::fill_n(work.products.begin(), count, 0);
  constexpr int kShift = kPlacementBits - kPositionBits;
  const Rgba* pixels = image.pixels.data();
  const int stride = image.stride();
  const int radius = window / 2;
  for (int index = 0; index < window * window; ++index) {
    const int dx = index % window - radius;
    const int dy = index / window - radius;
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::int32_t u = (work.u[i] + (dx * work.u_x[i] + dy * work.u_y[i])) >> kShift;
      const std::int32_t v = (work.v[i] + (dx * work.v_x[i] + dy * work.v_y[i])) >> kShift;
      work.fraction_x[i] = u & (kPositionScale - 1);
      work.fraction_y[i] = v & (kPositionScale - 1);
      work.texel_index[i] = (v >> kPositionBits) * stride + (u >> kPositionBits);
    }
    for (std::size_t i = 0; i < lanes; ++i) {
      const Rgba* texel = pixels + work.texel_index[i];
      work.top[i] = texel_pair(texel);
      work.bottom[i] = texel_pair(texel + stride);
    }
    add_samples(work.reference[static_cast<std::size_t>(index)], lanes, shift, work);
  }
}

/// Adds one neighbor's votes. Same operations as ncc_from_sums().
[[gnu::always_inline]] inline void vote_for_planes(float threshold, const Workspace& work, PlaneBatch& batch) {
  const auto lanes = static_cast<std::size_t>(batch.count);
  for (std::size_t i = 0; i < lanes; ++i) {
    const double samples = work.support_samples[i];
    const double red = work.sum_b[0][i];
    const double green = work.sum_b[1][i];
    const double blue = work.sum_b[2][i];
    const float covariance = float_from_integer(
        samples * work.products[i] - (work.sum_a[0][i] * red + work.sum_a[1][i] * green + work.sum_a[2][i] * blue));
    const float variance = float_from_integer(samples * work.squares[i] - (red * red + green * green + blue * blue));
    float ncc = (covariance * work.inverse_deviation[i]) * reciprocal_sqrt(variance);
    ncc = ncc < 1.0F ? ncc : 1.0F;
    const bool hit = (ncc > threshold) & (work.seen[i] != 0);
    batch.ncc_sum[i] += kept_if(hit, ncc);
    batch.votes[i] += static_cast<std::int32_t>(hit);
  }
}

/// Keeps the planes that `left` neighbors more can still make win. As long as some are left, moving the others closer
/// together must be worth it: with less than a quarter to drop all stay. texels: of a window.
void drop_losers(const PlaneScorer& scorer, int left, std::size_t texels, PlaneBatch& batch, Workspace& work) {
  const auto lanes = static_cast<std::size_t>(batch.count);
  Lanes<char> wins;
  std::size_t winners = 0;
  for (std::size_t i = 0; i < lanes; ++i) {
    wins[i] =
        static_cast<char>(can_win(batch.ncc_sum[i], batch.votes[i], left, batch.least_confidence[i], scorer.rule));
    winners += static_cast<std::size_t>(wins[i]);
  }
  if (left > 0 && winners > lanes - lanes / 4) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lanes; ++i) {
    if (wins[i] == 0) continue;
    if (kept != i) {
      batch.x[kept] = batch.x[i];
      batch.y[kept] = batch.y[i];
      batch.inverse_depth[kept] = batch.inverse_depth[i];
      batch.slope_x[kept] = batch.slope_x[i];
      batch.slope_y[kept] = batch.slope_y[i];
      batch.least_confidence[kept] = batch.least_confidence[i];
      batch.ncc_sum[kept] = batch.ncc_sum[i];
      batch.votes[kept] = batch.votes[i];
      if (left > 0) {
        for (auto& sum : work.sum_a) sum[kept] = sum[i];
        work.inverse_deviation[kept] = work.inverse_deviation[i];
        work.support_samples[kept] = work.support_samples[i];
        for (std::size_t texel = 0; texel < texels; ++texel) work.reference[texel][kept] = work.reference[texel][i];
      }
    }
    ++kept;
  }
  batch.count = static_cast<int>(kept);
}

[[gnu::always_inline]] inline void score_body(const PlaneScorer& scorer, PlaneBatch& batch, std::uint64_t& samples,
                                              Workspace& work) {
  const SweepTask& task = scorer.task;
  const int window = task.options.window;
  const int shift = kSampleShift + extra_sample_shift(window);
  read_supports(scorer, batch, window, shift, work);
  std::fill_n(batch.ncc_sum.begin(), batch.count, 0.0F);
  std::fill_n(batch.votes.begin(), batch.count, 0);
  const int neighbors = task.neighbor_count();
  for (int neighbor = 0; neighbor < neighbors && batch.count > 0; ++neighbor) {
    const auto index = static_cast<std::size_t>(neighbor);
    place_windows(task, index, batch, window / 2, work);
    sum_windows(*task.neighbors[index], batch.count, window, shift, work);
    vote_for_planes(scorer.rule.threshold, work, batch);
    samples += static_cast<std::uint64_t>(batch.count) * static_cast<std::uint64_t>(window * window);
    drop_losers(scorer, neighbors - 1 - neighbor, static_cast<std::size_t>(window * window), batch, work);
  }
}

using ScoreFunction = void (*)(const PlaneScorer&, PlaneBatch&, std::uint64_t&, Workspace&);

void score_baseline(const PlaneScorer& scorer, PlaneBatch& batch, std::uint64_t& samples, Workspace& work) {
  score_body(scorer, batch, samples, work);
}

#ifdef __x86_64__
[[gnu::target("arch=x86-64-v3")]] void score_avx2(const PlaneScorer& scorer, PlaneBatch& batch, std::uint64_t& samples,
                                                  Workspace& work) {
  score_body(scorer, batch, samples, work);
}

[[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] void score_avx512(const PlaneScorer& scorer,
                                                                            PlaneBatch& batch, std::uint64_t& samples,
                                                                            Workspace& work) {
  score_body(scorer, batch, samples, work);
}
#endif

ScoreFunction choose_score_function(SimdLevel simd) {
#ifdef __x86_64__
  if (simd == SimdLevel::kAvx512) return score_avx512;
  if (simd == SimdLevel::kAvx2) return score_avx2;
#endif
  static_cast<void>(simd);
  return score_baseline;
}

}  // namespace

float plane_ncc(const SweepTask& task, const SupportWindow& support, int neighbor, int x, int y,
                const PlaneTrial& plane) {
  const int window = task.options.window;
  const int radius = window / 2;
  const PaddedImage& image = *task.neighbors[static_cast<std::size_t>(neighbor)];
  const WindowPlacement at = place_window(task.warps[static_cast<std::size_t>(neighbor)], x, y, plane.inverse_depth,
                                          plane.slope_x, plane.slope_y, radius, image.width, image.height);
  if (!at.seen) return kNoNcc;
  const int extra_shift = extra_sample_shift(window);
  const Sample center = sample_bilinear(*task.reference, x * kPositionScale, y * kPositionScale, extra_shift);
  const int max_difference = (support.max_difference << 16) >> (kSampleShift + extra_shift);
  WindowSums sums;
  int samples = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const int shift = kPlacementBits - kPositionBits;
      const Sample a =
          sample_bilinear(*task.reference, (x + dx) * kPositionScale, (y + dy) * kPositionScale, extra_shift);
      const Sample b = sample_bilinear(image, (at.u + (dx * at.u_x + dy * at.u_y)) >> shift,
                                       (at.v + (dx * at.v_x + dy * at.v_y)) >> shift, extra_shift);
      if (std::max({std::abs(a.red - center.red), std::abs(a.green - center.green), std::abs(a.blue - center.blue)}) >
          max_difference)
        continue;
      add_sample(sums, a, b);
      ++samples;
    }
  }
  return ncc_from_sums(sums, samples);
}

void score_planes(const PlaneScorer& scorer, PlaneBatch& batch, std::uint64_t& samples) {
  QUORUM_CHECK_LE(static_cast<int>(scorer.simd), static_cast<int>(best_simd_level()));
  thread_local const auto work = std::make_unique<Workspace>();
  choose_score_function(scorer.simd)(scorer, batch, samples, *work);
}

}  // namespace quorum
