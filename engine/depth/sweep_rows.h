// What the sweep of a tile does along a row: positions in a neighbor, texels, samples, sums and votes. For
// sweep_tile.cc, which is compiled for each SIMD level: all loops run over plain arrays, so that the compiler
// vectorizes them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/project.h"
#include "engine/depth/reference_windows.h"
#include "engine/depth/sum_windows.h"

namespace quorum::sweep_rows {

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

}  // namespace quorum::sweep_rows
