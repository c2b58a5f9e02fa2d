// How a tile is swept: per plane and neighbor, rows of the tile (with the windows' border) are warped one after the
// other; each row's samples and products are summed along the row over the window's width, and these sums down the
// column by adding the new row and taking off the one that left the window. Windows along the image axes share no
// samples, but all samples of one lie at the same fractions of a pixel: a row of windows is summed sample by sample.
// All loops run along a row over plain arrays, so that the compiler vectorizes them; the whole is compiled for each
// SIMD level.
#include "engine/depth/sweep_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>

#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/project.h"
#include "engine/depth/reference_windows.h"
#include "engine/depth/sum_windows.h"

namespace quorum {
namespace {

constexpr int kMaxBorder = 14;  // 2 * radius of the largest window
constexpr int kRows = kMaxTileSide + kMaxBorder;
constexpr int kMaxWindow = 15;

// Loops take whole vectors, so that none of their work is done one by one: what lies beyond a row's end is computed,
// too, somewhere in the image, and not looked at. So arrays are one vector longer.
constexpr int kVector = 16;
constexpr int whole_vectors(int count) { return (count + kVector - 1) / kVector * kVector; }
constexpr int kWindows = kMaxTileSide + kVector;                              // of a row
constexpr int kColumns = whole_vectors(kMaxTileSide + kMaxBorder) + kVector;  // samples of a row

/// Samples of one row, and what is summed of them: channels of b, b·b, a·b.
enum Quantity { kRed, kGreen, kBlue, kSquares, kProducts, kQuantities };

/// Everything a thread needs to sweep a tile; arrays of the tile's reference part first, of the current row after.
struct Workspace {
  std::int32_t reference[3][kRows][kColumns];  // samples of the tile and its border
  std::uint64_t packed[kRows][kColumns];       // the same, 16 bits a channel
  std::int32_t reference_sum[3][kMaxTileSide][kWindows];
  float inverse_deviation[kMaxTileSide][kWindows];  // 1 / sqrt(n² variance) of each reference window
  float ncc_sum[kMaxTileSide][kWindows];
  std::int32_t votes[kMaxTileSide][kWindows];

  std::int32_t u[kColumns];  // 1/256 pixel
  std::int32_t v[kColumns];
  std::int32_t texel_index[kColumns];             // of the first of four
  std::uint64_t top[kColumns], bottom[kColumns];  // two texels side by side
  std::int32_t inside[kRows][kColumns];           // -1 inside the neighbor image, 0 outside
  std::int32_t sample[kQuantities][kColumns];
  std::int32_t row_sum[kMaxWindow + 1][kQuantities][kWindows];  // of the rows in the window, in turn
  std::int32_t window_sum[kQuantities][kWindows];

  // Of windows along the axes.
  std::uint32_t window_texel[(kMaxWindow + 1) * (kMaxWindow + 1)][kMaxTileSide];
  std::uint32_t along_red_blue[2][kMaxTileSide];  // AlongX of the row before and this one
  std::uint32_t along_green[2][kMaxTileSide];
};

/// The part of a tile that is swept on one plane: count_x × count_y windows, their first at (x, y) of the image and at
/// (tile_x, tile_y) of the tile.
struct Part {
  int x, y, tile_x, tile_y, count_x, count_y;
};

/// Positions of one row of samples in the neighbor. x, y: reference pixel of the first. Inside are those that keep a
/// margin (1/256 pixel) to the border of the image.
[[gnu::always_inline]] inline void warp_row(const PlaneWarp& warp, float inverse_depth, const PaddedImage& image, int x,
                                            int y, int count, int margin, std::int32_t* inside, Workspace& work) {
  const PlaneWarp row_warp = warp;  // a copy, so that what a row shares is computed once
  const int width = image.width;
  const int height = image.height;
  const int stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const Projection at = project(row_warp, x + i, y, inverse_depth, width, height, margin);
    inside[i] = -at.inside;
    work.u[i] = at.u;
    work.v[i] = at.v;
    work.texel_index[i] = texel_index(at.u, at.v, stride);
  }
}

/// Two texels side by side, and each of them.
[[gnu::always_inline]] inline std::uint64_t texel_pair(const Rgba* left) {
  std::uint64_t pair;
  std::memcpy(&pair, left, sizeof(pair));
  return pair;
}
constexpr int kLeftShift = std::endian::native == std::endian::little ? 0 : 32;
[[gnu::always_inline]] inline Rgba left_of(std::uint64_t pair) { return static_cast<Rgba>(pair >> kLeftShift); }
[[gnu::always_inline]] inline Rgba right_of(std::uint64_t pair) { return static_cast<Rgba>(pair >> (32 - kLeftShift)); }

/// Reads the four texels of each sample. Scalar on purpose: gathers are no faster, and far slower on some processors.
[[gnu::always_inline]] inline void read_texels(const PaddedImage& image, int count, Workspace& work) {
  const Rgba* pixels = image.pixels.data();
  const std::ptrdiff_t stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const Rgba* texel = pixels + work.texel_index[i];
    work.top[i] = texel_pair(texel);
    work.bottom[i] = texel_pair(texel + stride);
  }
}

/// Interpolates a row of samples, and multiplies.
[[gnu::always_inline]] inline void interpolate_row(int row, int column, int count, int shift, Workspace& work) {
  const std::int32_t* a_red = work.reference[0][row] + column;
  const std::int32_t* a_green = work.reference[1][row] + column;
  const std::int32_t* a_blue = work.reference[2][row] + column;
  for (int i = 0; i < count; ++i) {
    const Sample b = sample_bilinear(left_of(work.top[i]), right_of(work.top[i]), left_of(work.bottom[i]),
                                     right_of(work.bottom[i]), work.u[i], work.v[i], shift);
    work.sample[kRed][i] = b.red;
    work.sample[kGreen][i] = b.green;
    work.sample[kBlue][i] = b.blue;
    work.sample[kSquares][i] = product(b, b);
    work.sample[kProducts][i] = product({a_red[i], a_green[i], a_blue[i]}, b);
  }
}

/// sum[i] = in[i] + ... + in[i + kWindow - 1].
template <int kWindow>
[[gnu::always_inline]] inline void sum_along_row(const std::int32_t* in, int count, std::int32_t* sum) {
  for (int i = 0; i < count; ++i) {
    std::int32_t total = in[i];
#pragma GCC unroll 16
    for (int k = 1; k < kWindow; ++k) total += in[i + k];
    sum[i] = total;
  }
}

/// NCC of a row of windows from their sums, and the votes that follow. corner: flags of the windows' four corners, not
/// 0 where the neighbor sees it.
template <int kWindow>
[[gnu::always_inline]] inline void vote_row(int tile_x, int tile_y, int count,
                                            const std::array<const std::int32_t*, 4>& corner, float threshold,
                                            Workspace& work) {
  const std::int32_t* a_red = work.reference_sum[0][tile_y] + tile_x;
  const std::int32_t* a_green = work.reference_sum[1][tile_y] + tile_x;
  const std::int32_t* a_blue = work.reference_sum[2][tile_y] + tile_x;
  const float* inverse_deviation = work.inverse_deviation[tile_y] + tile_x;
  float* ncc_sum = work.ncc_sum[tile_y] + tile_x;
  std::int32_t* votes = work.votes[tile_y] + tile_x;
  const std::int32_t* upper_left = corner[0];
  const std::int32_t* upper_right = corner[1];
  const std::int32_t* lower_left = corner[2];
  const std::int32_t* lower_right = corner[3];
  for (int i = 0; i < count; ++i) {
    const ReferenceWindow window{{a_red[i], a_green[i], a_blue[i]}, inverse_deviation[i]};
    const WindowSums sums{{work.window_sum[kRed][i], work.window_sum[kGreen][i], work.window_sum[kBlue][i]},
                          work.window_sum[kSquares][i],
                          work.window_sum[kProducts][i]};
    const float ncc = ncc_from_sums(window, sums, kWindow * kWindow);
    const std::int32_t seen = upper_left[i] & upper_right[i] & lower_left[i] & lower_right[i];
    const bool hit = (ncc > threshold) & (seen != 0);
    ncc_sum[i] += hit ? ncc : 0.0F;
    votes[i] += hit ? 1 : 0;
  }
}

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

/// Sums of a row of windows along the image axes around the positions in work. inside: which windows the neighbor sees;
/// the others are taken somewhere in the image.
template <int kWindow>
[[gnu::always_inline]] inline void sum_axis_windows(const PaddedImage& image, const std::int32_t* inside, int tile_x,
                                                    int tile_y, int count, int shift, Workspace& work) {
  constexpr int kRadius = kWindow / 2;
  constexpr int kTexels = kWindow + 1;  // along a side
  const std::ptrdiff_t stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const std::ptrdiff_t first = inside[i] != 0 ? work.texel_index[i] - kRadius * stride - kRadius : 0;
    const Rgba* texel = image.pixels.data() + first;
    for (int row = 0; row < kTexels; ++row)
      for (int column = 0; column < kTexels; ++column)
        work.window_texel[row * kTexels + column][i] = texel[row * stride + column];
  }
  for (auto& sums : work.window_sum) std::fill_n(sums, count, 0);
  for (int column = 0; column < kWindow; ++column) {
    for (int row = 0; row < kTexels; ++row) {
      const std::uint32_t* left = work.window_texel[row * kTexels + column];
      const std::uint32_t* right = work.window_texel[row * kTexels + column + 1];
      std::uint32_t* red_blue = work.along_red_blue[row % 2];
      std::uint32_t* green = work.along_green[row % 2];
      for (int i = 0; i < count; ++i) {
        const AlongX along = interpolate_along_x(left[i], right[i], work.u[i]);
        red_blue[i] = along.red_blue;
        green[i] = along.green;
      }
      if (row == 0) continue;
      const std::uint32_t* red_blue_above = work.along_red_blue[(row + 1) % 2];
      const std::uint32_t* green_above = work.along_green[(row + 1) % 2];
      const std::int32_t* a_red = work.reference[0][tile_y + row - 1] + tile_x + column;
      const std::int32_t* a_green = work.reference[1][tile_y + row - 1] + tile_x + column;
      const std::int32_t* a_blue = work.reference[2][tile_y + row - 1] + tile_x + column;
      for (int i = 0; i < count; ++i) {
        const Sample a{a_red[i], a_green[i], a_blue[i]};
        const Sample b =
            interpolate_along_y({red_blue_above[i], green_above[i]}, {red_blue[i], green[i]}, work.v[i], shift);
        work.window_sum[kRed][i] += b.red;
        work.window_sum[kGreen][i] += b.green;
        work.window_sum[kBlue][i] += b.blue;
        work.window_sum[kSquares][i] += product(b, b);
        work.window_sum[kProducts][i] += product(a, b);
      }
    }
  }
}

/// As sweep_part, with the paper's windows along the image axes around the projection of the reference pixel. Windows
/// share nothing, so spans of a row in which no pixel tests the plane are skipped.
template <int kWindow>
[[gnu::always_inline]] inline void sweep_axis_part(const PlaneWarp& warp, const PaddedImage& image, float inverse_depth,
                                                   uint plane, const Grid<PlaneRange>& ranges, const Part& part,
                                                   int shift, float threshold, Workspace& work) {
  constexpr int kMargin = kWindow / 2 * kPositionScale;
  constexpr int kSpan = 16;
  if (image.width < kWindow || image.height < kWindow) return;
  std::int32_t* inside = work.inside[0];
  for (int row = 0; row < part.count_y; ++row) {
    const int y = part.y + row;
    for (int begin = 0; begin < part.count_x; begin += kSpan) {
      const int count = std::min(kSpan, part.count_x - begin);
      const PlaneRange* range = ranges.row(y) + part.x + begin;
      const auto tests_plane = [plane](const PlaneRange& r) { return plane >= r.first && plane <= r.last; };
      if (std::none_of(range, range + count, tests_plane)) continue;
      warp_row(warp, inverse_depth, image, part.x + begin, y, count, kMargin, inside, work);
      sum_axis_windows<kWindow>(image, inside, part.tile_x + begin, part.tile_y + row, count, shift, work);
      vote_row<kWindow>(part.tile_x + begin, part.tile_y + row, count, {inside, inside, inside, inside}, threshold,
                        work);
    }
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
      if (task.options.window_model != WindowModel::kAxis)
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
  if (row_sampler(simd) == nullptr || task.options.window_model == WindowModel::kAxis) return sweep;
  for (const auto& neighbor : task.neighbors) sweep.neighbors.push_back(make_texel_columns(*neighbor));
  return sweep;
}

void sweep_tile(const TileSweep& sweep, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, Grid<PixelVote>& votes) {
  thread_local const auto work = std::make_unique<Workspace>();
  choose_form(sweep.task.options.window, sweep.simd)(sweep, ranges, tile, planes, votes, *work);
}

}  // namespace quorum
