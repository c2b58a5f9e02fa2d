// How a tile is swept: per plane and neighbor, rows of the tile (with the windows' border) are warped one after the
// other; each row's samples and products are summed along the row over the window's width, and these sums down the
// column by adding the new row and taking off the one that left the window. The whole is compiled for each SIMD level.
#include "engine/depth/sweep_tile.h"

#include <algorithm>
#include <memory>

#include "engine/depth/reference_windows.h"
#include "engine/depth/sweep_axis_windows.h"
#include "engine/depth/sweep_rows.h"

namespace quorum {
namespace {

using namespace sweep_rows;

/// A neighbor, and how rows of it are sampled: by the sampler, if there is one.
struct Neighbor {
  const PlaneWarp& warp;
  const PaddedImage& image;
  const TexelColumns* columns;
  RowSampler sampler;
};

/// Samples of a row at the positions in work. row, column: of the tile's reference part.
[[gnu::always_inline]] inline void sample_row(const Neighbor& neighbor, int row, int column, int samples, int shift,
                                              Workspace& work) {
  const int whole_samples = whole_vectors(samples);
  if (neighbor.sampler != nullptr) {
    neighbor.sampler(
        *neighbor.columns, {work.u, work.v, work.texel_index}, work.packed[row] + column, whole_samples, shift,
        {work.sample[kRed], work.sample[kGreen], work.sample[kBlue], work.sample[kSquares], work.sample[kProducts]});
    return;
  }
  read_texels(neighbor.image, samples, work);
  interpolate_row(row, column, whole_samples, shift, work);
}

/// Adds the votes of one neighbor on one plane.
template <int kWindow>
[[gnu::always_inline]] inline void sweep_part(const Neighbor& neighbor, float inverse_depth, const Part& part,
                                              int shift, float threshold, Workspace& work) {
  constexpr int kRadius = kWindow / 2;
  const int samples = part.count_x + kWindow - 1;
  const int whole_samples = whole_vectors(samples);
  const int windows = whole_vectors(part.count_x);
  for (auto& sums : work.window_sum) std::fill_n(sums, windows, 0);
  for (int row = 0; row < part.count_y + kWindow - 1; ++row) {
    std::int32_t* inside = work.inside[row];
    warp_row(neighbor.warp, inverse_depth, neighbor.image, part.x - kRadius, part.y - kRadius + row, whole_samples, 0,
             inside, work);
    sample_row(neighbor, part.tile_y + row, part.tile_x, samples, shift, work);
    auto& entering = work.row_sum[row % (kWindow + 1)];
    const auto& leaving = work.row_sum[(row + 1) % (kWindow + 1)];  // kWindow rows back
    for (int quantity = 0; quantity < kQuantities; ++quantity) {
      sum_along_row<kWindow>(work.sample[quantity], windows, entering[quantity]);
      std::int32_t* sum = work.window_sum[quantity];
      const bool full = row >= kWindow;
      for (int i = 0; i < windows; ++i) sum[i] += entering[quantity][i] - (full ? leaving[quantity][i] : 0);
    }
    if (row < kWindow - 1) continue;
    const std::int32_t* top = work.inside[row - (kWindow - 1)];
    vote_row<kWindow>(part.tile_x, part.tile_y + row - (kWindow - 1), windows,
                      {top, top + kWindow - 1, inside, inside + kWindow - 1}, threshold, work);
  }
}

/// Samples of the reference in the tile and its border, and the sums of its windows.
template <int kWindow>
[[gnu::always_inline]] inline void prepare_reference(const PaddedImage& image, const Tile& tile, int shift,
                                                     Workspace& work) {
  constexpr int kRadius = kWindow / 2;
  const int count_x = tile.x_end - tile.x;
  const int count_y = tile.y_end - tile.y;
  for (int row = 0; row < count_y + kWindow - 1; ++row) {
    const int y = std::clamp(tile.y - kRadius + row, 0, image.height - 1);
    for (int column = 0; column < count_x + kWindow - 1; ++column) {
      const int x = std::clamp(tile.x - kRadius + column, 0, image.width - 1);
      const Sample sample = sample_pixel(image.at(x, y), shift);
      work.reference[0][row][column] = sample.red;
      work.reference[1][row][column] = sample.green;
      work.reference[2][row][column] = sample.blue;
      const auto word = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint16_t>(value)}; };
      work.packed[row][column] = word(sample.red) | word(sample.green) << 16 | word(sample.blue) << 32;
    }
  }
  for (int y = 0; y < count_y; ++y) {
    for (int x = 0; x < count_x; ++x) {
      ReferenceSums sums;
      for (int dy = 0; dy < kWindow; ++dy)
        for (int dx = 0; dx < kWindow; ++dx)
          add_sample(sums, {work.reference[0][y + dy][x + dx], work.reference[1][y + dy][x + dx],
                            work.reference[2][y + dy][x + dx]});
      const ReferenceWindow window = window_from_sums(sums, kWindow * kWindow);
      for (int channel = 0; channel < 3; ++channel) work.reference_sum[channel][y][x] = window.sum[channel];
      work.inverse_deviation[y][x] = window.inverse_deviation;
    }
  }
}

template <int kWindow>
[[gnu::always_inline]] inline void sweep_tile_body(const TileSweep& sweep, const Grid<PlaneRange>& ranges,
                                                   const Tile& tile, const std::vector<TilePlane>& planes,
                                                   Grid<PixelVote>& votes, Workspace& work) {
  const SweepTask& task = sweep.task;
  const VoteRule rule = sweep.rule;
  const RowSampler sampler = sweep.neighbors.empty() ? nullptr : row_sampler(sweep.simd);
  const int shift = kSampleShift + extra_sample_shift(kWindow);
  prepare_reference<kWindow>(*task.reference, tile, shift, work);
  for (const auto& [plane, at] : planes) {
    const Part part{at.x, at.y, at.x - tile.x, at.y - tile.y, at.x_end - at.x, at.y_end - at.y};
    for (int y = part.tile_y; y < part.tile_y + part.count_y; ++y) {
      std::fill_n(work.ncc_sum[y] + part.tile_x, part.count_x, 0.0F);
      std::fill_n(work.votes[y] + part.tile_x, part.count_x, 0);
    }
    const float inverse_depth = task.planes.inverse_depth[static_cast<std::size_t>(plane)];
    for (std::size_t neighbor = 0; neighbor < task.neighbors.size(); ++neighbor) {
      const PlaneWarp& warp = task.warps[neighbor];
      const PaddedImage& image = *task.neighbors[neighbor];
      const TexelColumns* columns = sampler != nullptr ? &sweep.neighbors[neighbor] : nullptr;
      if (!task.options.is_along_axes())
        sweep_part<kWindow>({warp, image, columns, sampler}, inverse_depth, part, shift, rule.threshold, work);
      else
        sweep_axis_part<kWindow>(warp, image, inverse_depth, static_cast<uint>(plane), ranges, part, shift,
                                 rule.threshold, work);
    }
    const auto index = static_cast<uint>(plane);
    for (int y = 0; y < part.count_y; ++y) {
      const PlaneRange* range = ranges.row(at.y + y) + at.x;
      PixelVote* best = votes.row(at.y + y) + at.x;
      const float* ncc_sum = work.ncc_sum[part.tile_y + y] + part.tile_x;
      const std::int32_t* count = work.votes[part.tile_y + y] + part.tile_x;
      for (int x = 0; x < part.count_x; ++x)
        if (count[x] >= rule.min_votes && index >= range[x].first && index <= range[x].last)
          best[x] = vote(best[x], ncc_sum[x], count[x], plane, rule);
    }
  }
}

auto choose_form(int window, SimdLevel simd) {
  switch (window) {
    case 3:
      return simd_form<sweep_tile_body<3>>(simd);
    case 5:
      return simd_form<sweep_tile_body<5>>(simd);
    case 7:
      return simd_form<sweep_tile_body<7>>(simd);
    case 9:
      return simd_form<sweep_tile_body<9>>(simd);
    case 11:
      return simd_form<sweep_tile_body<11>>(simd);
    case 13:
      return simd_form<sweep_tile_body<13>>(simd);
    default:
      return simd_form<sweep_tile_body<15>>(simd);
  }
}

}  // namespace

TileSweep make_tile_sweep(const SweepTask& task, SimdLevel simd) {
  TileSweep sweep{task, make_vote_rule(task.options, task.neighbor_count()), simd, {}};
  if (row_sampler(simd) == nullptr || task.options.is_along_axes()) return sweep;
  for (const auto& neighbor : task.neighbors) sweep.neighbors.push_back(make_texel_columns(*neighbor));
  return sweep;
}

void sweep_tile(const TileSweep& sweep, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, Grid<PixelVote>& votes) {
  thread_local const auto work = std::make_unique<Workspace>();
  choose_form(sweep.task.options.window, sweep.simd)(sweep, ranges, tile, planes, votes, *work);
}

}  // namespace quorum
