// Loops run over the planes of a batch, with arrays for what differs between them, so that the compiler vectorizes
// them; compiled for each SIMD level. The innermost one has vectors of its own (sum_windows.h).
#include "engine/depth/score_planes.h"

#include <algorithm>
#include <memory>

#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/place_window.h"
#include "engine/depth/plane_moves.h"
#include "engine/depth/reference_windows.h"
#include "engine/depth/sum_windows.h"
#include "engine/depth/vote_depth.h"

namespace quorum {
namespace {

static_assert(PlaneBatch::kCapacity == WindowLanes::kCapacity);

template <typename T>
using Lanes = std::array<T, PlaneBatch::kCapacity>;

/// What a thread needs to score a batch.
struct ScoreWorkspace {
  // Of the supports, for all neighbors.
  Lanes<std::int32_t> sum_a[3];
  Lanes<float> inverse_deviation;
  Lanes<std::int32_t> support_samples;

  // Of one neighbor.
  WindowLanes windows;
  Lanes<std::int32_t> seen;
};

constexpr std::size_t kGroup = WindowLanes::kGroup;

constexpr std::size_t whole_groups(int lanes) {
  return (static_cast<std::size_t>(lanes) + kGroup - 1) / kGroup * kGroup;
}

/// Supports of the batch: their sums, and their samples of the reference.
[[gnu::always_inline]] inline void read_supports(const PlaneScorer& scorer, const TileSupports& supports,
                                                 const WindowSumForm& form, const PlaneBatch& batch,
                                                 ScoreWorkspace& work) {
  const auto lanes = static_cast<std::size_t>(batch.count);
  Lanes<std::int32_t> pixel = {};
  for (std::size_t i = 0; i < lanes; ++i) {
    const SupportWindow& support = scorer.windows.at(batch.x[i], batch.y[i]);
    for (std::size_t channel = 0; channel < 3; ++channel) work.sum_a[channel][i] = support.sum[channel];
    work.inverse_deviation[i] = support.inverse_deviation;
    work.support_samples[i] = support.samples;
    pixel[i] = supports.pixel(batch.x[i], batch.y[i]);
  }
  const int places = work.windows.window * work.windows.window;
  WindowLanes::Place* place = work.windows.reference.data();
  for (std::size_t first = 0; first < whole_groups(batch.count); first += kGroup) {
    std::array<std::int32_t, kGroup> ordered;
    for (std::size_t i = 0; i < kGroup; ++i) ordered[i] = pixel[first + form.order[i]];
    for (int index = 0; index < places; ++index, ++place) {
      const std::uint64_t* samples = supports.samples(index);
      for (std::size_t i = 0; i < kGroup; ++i) place->samples[i] = samples[ordered[i]];
    }
  }
}

[[gnu::always_inline]] inline void place_windows(const SweepTask& task, std::size_t neighbor, const PlaneBatch& batch,
                                                 int radius, ScoreWorkspace& work) {
  const PlaneWarp warp = task.warps[neighbor];
  const int width = task.neighbors[neighbor]->width;
  const int height = task.neighbors[neighbor]->height;
  const auto lanes = static_cast<std::size_t>(batch.count);
  for (std::size_t i = 0; i < lanes; ++i) {
    const WindowPlacement at = place_window(warp, batch.x[i], batch.y[i], batch.inverse_depth[i], batch.slope_x[i],
                                            batch.slope_y[i], radius, width, height);
    const std::int32_t seen = -static_cast<std::int32_t>(at.seen);
    work.seen[i] = seen;
    work.windows.u[i] = at.u & seen;
    work.windows.v[i] = at.v & seen;
    work.windows.u_x[i] = at.u_x & seen;
    work.windows.v_x[i] = at.v_x & seen;
    work.windows.u_y[i] = at.u_y & seen;
    work.windows.v_y[i] = at.v_y & seen;
  }
  // Lanes of the last group that have no plane read the image's first texels.
  for (auto* values :
       {&work.windows.u, &work.windows.v, &work.windows.u_x, &work.windows.v_x, &work.windows.u_y, &work.windows.v_y})
    std::fill(values->begin() + batch.count, values->begin() + static_cast<std::ptrdiff_t>(whole_groups(batch.count)),
              0);
}

/// Adds one neighbor's votes.
[[gnu::always_inline]] inline void vote_for_planes(float threshold, const ScoreWorkspace& work, PlaneBatch& batch) {
  const auto lanes = static_cast<std::size_t>(batch.count);
  for (std::size_t i = 0; i < lanes; ++i) {
    const ReferenceWindow window{{work.sum_a[0][i], work.sum_a[1][i], work.sum_a[2][i]}, work.inverse_deviation[i]};
    const WindowSums sums{
        {work.windows.b[0][i], work.windows.b[1][i], work.windows.b[2][i]}, work.windows.bb[i], work.windows.ab[i]};
    const float ncc = ncc_from_sums(window, sums, work.support_samples[i]);
    const bool hit = (ncc > threshold) & (work.seen[i] != 0);
    batch.ncc_sum[i] += kept_if(hit, ncc);
    batch.votes[i] += static_cast<std::int32_t>(hit);
  }
}

/// Keeps the planes that `left` neighbors more can still make win. As long as some are left, moving the others closer
/// together must be worth it: with less than a quarter to drop all stay. True if some were dropped.
[[gnu::always_inline]] inline bool drop_losers(const PlaneScorer& scorer, int left, PlaneBatch& batch) {
  const auto lanes = static_cast<std::size_t>(batch.count);
  const VoteRule rule = scorer.rule;
  Lanes<std::int32_t> wins;
  std::int32_t winners = 0;
  for (std::size_t i = 0; i < lanes; ++i) {
    wins[i] =
        static_cast<std::int32_t>(can_win(batch.ncc_sum[i], batch.votes[i], left, batch.least_confidence[i], rule));
    winners += wins[i];
  }
  if (left > 0 && winners > batch.count - batch.count / 4) return false;
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
    }
    ++kept;
  }
  batch.count = static_cast<int>(kept);
  return kept < lanes;
}

[[gnu::always_inline]] inline void score_body(const PlaneScorer& scorer, const TileSupports& supports,
                                              PlaneBatch& batch, std::uint64_t& samples, ScoreWorkspace& work) {
  const SweepTask& task = scorer.task;
  const int window = task.options.window;
  const WindowSumForm form = window_sum_form(scorer.simd);
  work.windows.window = window;
  work.windows.reference.resize(PlaneBatch::kCapacity / kGroup * static_cast<std::size_t>(window * window));
  read_supports(scorer, supports, form, batch, work);
  std::fill_n(batch.ncc_sum.begin(), batch.count, 0.0F);
  std::fill_n(batch.votes.begin(), batch.count, 0);
  const int neighbors = task.neighbor_count();
  for (int neighbor = 0; neighbor < neighbors && batch.count > 0; ++neighbor) {
    const auto index = static_cast<std::size_t>(neighbor);
    place_windows(task, index, batch, window / 2, work);
    form.sum(scorer.neighbors[index], batch.count, kSampleShift + extra_sample_shift(window), work.windows);
    vote_for_planes(scorer.rule.threshold, work, batch);
    samples += static_cast<std::uint64_t>(batch.count) * static_cast<std::uint64_t>(window * window);
    const int left = neighbors - 1 - neighbor;
    if (drop_losers(scorer, left, batch) && left > 0) read_supports(scorer, supports, form, batch, work);
  }
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
  const Rgba center = task.reference->at(x, y);
  ReferenceSums reference;
  WindowSums sums;
  int samples = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Rgba pixel = task.reference->at(x + dx, y + dy);
      if (largest_difference(pixel, center) > support.max_difference) continue;
      const Sample a = sample_pixel(pixel, kSampleShift + extra_shift);
      add_sample(reference, a);
      add_sample(sums, a,
                 sample_bilinear(image, place_sample(at.u, at.u_x, at.u_y, dx, dy),
                                 place_sample(at.v, at.v_x, at.v_y, dx, dy), extra_shift));
      ++samples;
    }
  }
  return ncc_from_sums(window_from_sums(reference, samples), sums, samples);
}

PlaneScorer make_plane_scorer(const SweepTask& task, const Grid<SupportWindow>& windows, SimdLevel simd) {
  PlaneScorer scorer{task, windows, make_vote_rule(task.options, task.neighbor_count()), simd, {}};
  for (const auto& neighbor : task.neighbors) scorer.neighbors.push_back(make_texel_columns(*neighbor));
  return scorer;
}

void score_planes(const PlaneScorer& scorer, const TileSupports& supports, PlaneBatch& batch, std::uint64_t& samples) {
  thread_local const auto work = std::make_unique<ScoreWorkspace>();
  simd_form<score_body>(scorer.simd)(scorer, supports, batch, samples, *work);
}

}  // namespace quorum
