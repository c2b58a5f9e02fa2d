// How a tile is swept: per plane and neighbor, rows of the tile (with the windows' border) are warped one after the
// other; each row's samples and products are summed along the row over the window's width, and these sums down the
// column by adding the new row and taking off the one that left the window. Windows along the image axes share no
// samples, but all samples of one lie at the same fractions of a pixel: a row of windows is summed sample by sample.
// All loops run along a row over plain arrays, so that the compiler vectorizes them; the whole is compiled for three
// instruction sets and chosen at run time.
#include "engine/depth/sweep_tile.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "engine/core/check.h"
#include "engine/core/exact.h"
#include "engine/depth/window_ncc.h"

namespace quorum {
namespace {

constexpr int kMaxBorder = 14;                           // 2 * radius of the largest window
constexpr int kColumns = kMaxTileSide + kMaxBorder + 2;  // 80: whole vectors
constexpr int kRows = kMaxTileSide + kMaxBorder;
constexpr int kMaxWindow = 15;

/// Samples of one row, and what is summed of them: channels of b, b·b, a·b.
enum Quantity { kRed, kGreen, kBlue, kSquares, kProducts, kQuantities };

/// Everything a thread needs to sweep a tile; arrays of the tile's reference part first, of the current row after.
struct Workspace {
  std::int32_t reference[3][kRows][kColumns];  // samples of the tile and its border
  std::int32_t reference_sum[3][kMaxTileSide][kMaxTileSide];
  float inverse_deviation[kMaxTileSide][kMaxTileSide];  // 1 / sqrt(n² variance) of each reference window
  float ncc_sum[kMaxTileSide][kMaxTileSide];
  std::int32_t votes[kMaxTileSide][kMaxTileSide];

  std::int32_t texel_index[kColumns];
  std::int32_t fraction_x[kColumns];
  std::int32_t fraction_y[kColumns];
  std::uint32_t texel[4][kColumns];      // upper left, upper right, lower left, lower right
  std::int32_t inside[kRows][kColumns];  // -1 inside the neighbor image, 0 outside
  std::int32_t sample[kQuantities][kColumns];
  std::int32_t row_sum[kMaxWindow + 1][kQuantities][kMaxTileSide];  // of the rows in the window, in turn
  std::int32_t window_sum[kQuantities][kMaxTileSide];

  // Of windows along the axes.
  std::uint32_t window_texel[(kMaxWindow + 1) * (kMaxWindow + 1)][kMaxTileSide];
  std::uint32_t along_red_blue[2][kMaxTileSide];  // of the row before and this one, interpolated along x
  std::uint32_t along_green[2][kMaxTileSide];
};

/// The part of a tile that is swept on one plane: count_x × count_y windows, their first at (x, y) of the image and at
/// (tile_x, tile_y) of the tile.
struct Part {
  int x, y, tile_x, tile_y, count_x, count_y;
};

/// Positions of one row of samples in the neighbor. x, y: reference pixel of the first. Inside are those that keep a
/// margin (1/256 pixel) to the border of the image. Same operations as project().
[[gnu::always_inline]] inline void warp_row(const PlaneWarp& warp, float inverse_depth, const PaddedImage& image, int x,
                                            int y, int count, int margin, std::int32_t* inside, Workspace& work) {
  const float* m = warp.rotation;
  const float fy = static_cast<float>(y);
  const float base_x = m[1] * fy + (m[2] + warp.offset[0] * inverse_depth);
  const float base_y = m[4] * fy + (m[5] + warp.offset[1] * inverse_depth);
  const float base_z = m[7] * fy + (m[8] + warp.offset[2] * inverse_depth);
  const float m0 = m[0];
  const float m3 = m[3];
  const float m6 = m[6];
  const float least = static_cast<float>(margin);
  const float limit_u = static_cast<float>((image.width - 1) * kPositionScale + 1 - margin);
  const float limit_v = static_cast<float>((image.height - 1) * kPositionScale + 1 - margin);
  const int stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const float fx = static_cast<float>(x + i);
    const float px = m0 * fx + base_x;
    const float py = m3 * fx + base_y;
    const float pz = m6 * fx + base_z;
    const bool before = pz > kMinDepthRatio;
    const float inverse_z = reciprocal(before ? pz : 1.0F);
    const float u = (px * inverse_z) * static_cast<float>(kPositionScale) + 0.5F;
    const float v = (py * inverse_z) * static_cast<float>(kPositionScale) + 0.5F;
    const bool in = before & (u >= least) & (v >= least) & (u < limit_u) & (v < limit_v);
    const int iu = static_cast<int>(in ? u : 0.0F);
    const int iv = static_cast<int>(in ? v : 0.0F);
    inside[i] = in ? -1 : 0;
    work.fraction_x[i] = iu & (kPositionScale - 1);
    work.fraction_y[i] = iv & (kPositionScale - 1);
    work.texel_index[i] = (iv >> kPositionBits) * stride + (iu >> kPositionBits);
  }
}

/// Reads the four texels of each sample. Scalar on purpose: gathers are no faster, and far slower on some processors.
[[gnu::always_inline]] inline void read_texels(const PaddedImage& image, int count, Workspace& work) {
  const Rgba* pixels = image.pixels.data();
  const std::ptrdiff_t stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const Rgba* texel = pixels + work.texel_index[i];
    work.texel[0][i] = texel[0];
    work.texel[1][i] = texel[1];
    work.texel[2][i] = texel[stride];
    work.texel[3][i] = texel[stride + 1];
  }
}

/// Interpolates a row of samples, and multiplies.
[[gnu::always_inline]] inline void interpolate_row(int row, int column, int count, int shift, Workspace& work) {
  const std::int32_t* a_red = work.reference[0][row] + column;
  const std::int32_t* a_green = work.reference[1][row] + column;
  const std::int32_t* a_blue = work.reference[2][row] + column;
  for (int i = 0; i < count; ++i) {
    const Sample b = interpolate_texels(work.texel[0][i], work.texel[1][i], work.texel[2][i], work.texel[3][i],
                                        static_cast<std::uint32_t>(work.fraction_x[i]),
                                        static_cast<std::uint32_t>(work.fraction_y[i]), shift);
    work.sample[kRed][i] = b.red;
    work.sample[kGreen][i] = b.green;
    work.sample[kBlue][i] = b.blue;
    work.sample[kSquares][i] = b.red * b.red + b.green * b.green + b.blue * b.blue;
    work.sample[kProducts][i] = a_red[i] * b.red + a_green[i] * b.green + a_blue[i] * b.blue;
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
/// 0 where the neighbor sees it. Same operations as ncc_from_sums().
template <int kWindow>
[[gnu::always_inline]] inline void vote_row(int tile_x, int tile_y, int count,
                                            const std::array<const std::int32_t*, 4>& corner, float threshold,
                                            Workspace& work) {
  constexpr double kSamples = kWindow * kWindow;
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
    const double red = work.window_sum[kRed][i];
    const double green = work.window_sum[kGreen][i];
    const double blue = work.window_sum[kBlue][i];
    const float covariance = float_from_integer(kSamples * work.window_sum[kProducts][i] -
                                                (a_red[i] * red + a_green[i] * green + a_blue[i] * blue));
    const float variance =
        float_from_integer(kSamples * work.window_sum[kSquares][i] - (red * red + green * green + blue * blue));
    float ncc = (covariance * inverse_deviation[i]) * reciprocal_sqrt(variance);
    ncc = ncc < 1.0F ? ncc : 1.0F;
    const std::int32_t seen = upper_left[i] & upper_right[i] & lower_left[i] & lower_right[i];
    const bool hit = (ncc > threshold) & (seen != 0);
    ncc_sum[i] += hit ? ncc : 0.0F;
    votes[i] += hit ? 1 : 0;
  }
}

/// Adds the votes of one neighbor on one plane.
template <int kWindow>
[[gnu::always_inline]] inline void sweep_part(const PlaneWarp& warp, const PaddedImage& image, float inverse_depth,
                                              const Part& part, int shift, float threshold, Workspace& work) {
  constexpr int kRadius = kWindow / 2;
  const int samples = part.count_x + kWindow - 1;
  for (auto& sums : work.window_sum) std::fill_n(sums, part.count_x, 0);
  for (int row = 0; row < part.count_y + kWindow - 1; ++row) {
    std::int32_t* inside = work.inside[row];
    warp_row(warp, inverse_depth, image, part.x - kRadius, part.y - kRadius + row, samples, 0, inside, work);
    read_texels(image, samples, work);
    interpolate_row(part.tile_y + row, part.tile_x, samples, shift, work);
    auto& entering = work.row_sum[row % (kWindow + 1)];
    const auto& leaving = work.row_sum[(row + 1) % (kWindow + 1)];  // kWindow rows back
    for (int quantity = 0; quantity < kQuantities; ++quantity) {
      sum_along_row<kWindow>(work.sample[quantity], part.count_x, entering[quantity]);
      std::int32_t* sum = work.window_sum[quantity];
      const bool full = row >= kWindow;
      for (int i = 0; i < part.count_x; ++i) sum[i] += entering[quantity][i] - (full ? leaving[quantity][i] : 0);
    }
    if (row < kWindow - 1) continue;
    const std::int32_t* top = work.inside[row - (kWindow - 1)];
    vote_row<kWindow>(part.tile_x, part.tile_y + row - (kWindow - 1), part.count_x,
                      {top, top + kWindow - 1, inside, inside + kWindow - 1}, threshold, work);
  }
}

/// Sums of a row of windows along the image axes around the positions in work. inside: which windows the neighbor sees;
/// the others are taken somewhere in the image.
template <int kWindow>
[[gnu::always_inline]] inline void sum_axis_windows(const PaddedImage& image, const std::int32_t* inside, int tile_x,
                                                    int tile_y, int count, int shift, Workspace& work) {
  constexpr std::uint32_t kRedBlue = 0x00ff00ffU;
  constexpr int kRadius = kWindow / 2;
  constexpr int kTexels = kWindow + 1;  // along a side
  const std::int32_t center = 1 << (23 - shift);
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
        const auto fraction = static_cast<std::uint32_t>(work.fraction_x[i]);
        const std::uint32_t left_red_blue = left[i] & kRedBlue;
        red_blue[i] = (left_red_blue << 8) + ((right[i] & kRedBlue) - left_red_blue) * fraction;
        green[i] = (green_of(left[i]) << 8) + (green_of(right[i]) - green_of(left[i])) * fraction;
      }
      if (row == 0) continue;
      const std::uint32_t* red_blue_above = work.along_red_blue[(row + 1) % 2];
      const std::uint32_t* green_above = work.along_green[(row + 1) % 2];
      const std::int32_t* a_red = work.reference[0][tile_y + row - 1] + tile_x + column;
      const std::int32_t* a_green = work.reference[1][tile_y + row - 1] + tile_x + column;
      const std::int32_t* a_blue = work.reference[2][tile_y + row - 1] + tile_x + column;
      for (int i = 0; i < count; ++i) {
        const auto along_y = [&](std::uint32_t top, std::uint32_t bottom) {
          const auto fraction = static_cast<std::uint32_t>(work.fraction_y[i]);
          return static_cast<std::int32_t>(((top << 8) + (bottom - top) * fraction) >> shift) - center;
        };
        const std::int32_t b_red = along_y(red_blue_above[i] & 0xffffU, red_blue[i] & 0xffffU);
        const std::int32_t b_green = along_y(green_above[i], green[i]);
        const std::int32_t b_blue = along_y(red_blue_above[i] >> 16, red_blue[i] >> 16);
        work.window_sum[kRed][i] += b_red;
        work.window_sum[kGreen][i] += b_green;
        work.window_sum[kBlue][i] += b_blue;
        work.window_sum[kSquares][i] += b_red * b_red + b_green * b_green + b_blue * b_blue;
        work.window_sum[kProducts][i] += a_red[i] * b_red + a_green[i] * b_green + a_blue[i] * b_blue;
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
  constexpr double kSamples = kWindow * kWindow;
  const int count_x = tile.x_end - tile.x;
  const int count_y = tile.y_end - tile.y;
  const std::int32_t center = 1 << (23 - shift);
  for (int row = 0; row < count_y + kWindow - 1; ++row) {
    const int y = std::clamp(tile.y - kRadius + row, 0, image.height - 1);
    for (int column = 0; column < count_x + kWindow - 1; ++column) {
      const Rgba pixel = image.at(std::clamp(tile.x - kRadius + column, 0, image.width - 1), y);
      const auto sample = [&](std::uint32_t value) {
        return static_cast<std::int32_t>((value << 16) >> shift) - center;
      };
      work.reference[0][row][column] = sample(red_of(pixel));
      work.reference[1][row][column] = sample(green_of(pixel));
      work.reference[2][row][column] = sample(blue_of(pixel));
    }
  }
  for (int y = 0; y < count_y; ++y) {
    for (int x = 0; x < count_x; ++x) {
      std::int32_t sum[3] = {};
      std::int32_t squares = 0;
      for (int dy = 0; dy < kWindow; ++dy) {
        for (int dx = 0; dx < kWindow; ++dx) {
          for (int channel = 0; channel < 3; ++channel) {
            const std::int32_t value = work.reference[channel][y + dy][x + dx];
            sum[channel] += value;
            squares += value * value;
          }
        }
      }
      double variance = kSamples * squares;
      double product = 0.0;
      for (int channel = 0; channel < 3; ++channel) {
        work.reference_sum[channel][y][x] = sum[channel];
        product += static_cast<double>(sum[channel]) * sum[channel];
      }
      variance -= product;
      work.inverse_deviation[y][x] = reciprocal_sqrt(float_from_integer(variance));
    }
  }
}

template <int kWindow>
[[gnu::always_inline]] inline void sweep_tile_body(const SweepTask& task, const Grid<PlaneRange>& ranges,
                                                   const Tile& tile, const std::vector<TilePlane>& planes,
                                                   const VoteRule& rule, Grid<PixelVote>& votes, Workspace& work) {
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
      if (task.options.window_model != WindowModel::kAxis)
        sweep_part<kWindow>(warp, image, inverse_depth, part, shift, rule.threshold, work);
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

using TileFunction = void (*)(const SweepTask&, const Grid<PlaneRange>&, const Tile&, const std::vector<TilePlane>&,
                              const VoteRule&, Grid<PixelVote>&, Workspace&);

template <int kWindow>
void sweep_tile_baseline(const SweepTask& task, const Grid<PlaneRange>& ranges, const Tile& tile,
                         const std::vector<TilePlane>& planes, const VoteRule& rule, Grid<PixelVote>& votes,
                         Workspace& work) {
  sweep_tile_body<kWindow>(task, ranges, tile, planes, rule, votes, work);
}

#ifdef __x86_64__
template <int kWindow>
[[gnu::target("arch=x86-64-v3")]] void sweep_tile_avx2(const SweepTask& task, const Grid<PlaneRange>& ranges,
                                                       const Tile& tile, const std::vector<TilePlane>& planes,
                                                       const VoteRule& rule, Grid<PixelVote>& votes, Workspace& work) {
  sweep_tile_body<kWindow>(task, ranges, tile, planes, rule, votes, work);
}

template <int kWindow>
[[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] void sweep_tile_avx512(
    const SweepTask& task, const Grid<PlaneRange>& ranges, const Tile& tile, const std::vector<TilePlane>& planes,
    const VoteRule& rule, Grid<PixelVote>& votes, Workspace& work) {
  sweep_tile_body<kWindow>(task, ranges, tile, planes, rule, votes, work);
}
#endif

template <int kWindow>
TileFunction choose_tile_function(SimdLevel simd) {
#ifdef __x86_64__
  if (simd == SimdLevel::kAvx512) return sweep_tile_avx512<kWindow>;
  if (simd == SimdLevel::kAvx2) return sweep_tile_avx2<kWindow>;
#endif
  static_cast<void>(simd);
  return sweep_tile_baseline<kWindow>;
}

TileFunction choose_tile_function(int window, SimdLevel simd) {
  switch (window) {
    case 3:
      return choose_tile_function<3>(simd);
    case 5:
      return choose_tile_function<5>(simd);
    case 7:
      return choose_tile_function<7>(simd);
    case 9:
      return choose_tile_function<9>(simd);
    case 11:
      return choose_tile_function<11>(simd);
    case 13:
      return choose_tile_function<13>(simd);
    default:
      return choose_tile_function<15>(simd);
  }
}

}  // namespace

void sweep_tile(const SweepTask& task, const Grid<PlaneRange>& ranges, const Tile& tile,
                const std::vector<TilePlane>& planes, const VoteRule& rule, SimdLevel simd, Grid<PixelVote>& votes) {
  QUORUM_CHECK_LE(static_cast<int>(simd), static_cast<int>(best_simd_level()));
  thread_local const auto work = std::make_unique<Workspace>();
  choose_tile_function(task.options.window, simd)(task, ranges, tile, planes, rule, votes, *work);
}

}  // namespace quorum
