// The sweep of windows along the image axes, the paper's own. They share no samples, but all samples of one lie at the
// same fractions of a pixel: a row of windows is summed sample by sample. For sweep_tile.cc.
#pragma once

#include "engine/depth/sweep_rows.h"

namespace quorum::sweep_rows {

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

}  // namespace quorum::sweep_rows
