// Images as sweep_depth_lanes reads them: as texels of four words, so that one read gives what one step needs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/grid.h"
#include "engine/image/padded_image.h"
#include "shaders/layout.h"

namespace quorum {

using Texel = std::array<std::uint32_t, 4>;

/// The least multiple of kBlockMultiple that holds size pixels.
constexpr int whole_blocks(int size) { return (size + kBlockMultiple - 1) / kBlockMultiple * kBlockMultiple; }

/// A grid of whole blocks: what lies beyond the given one is 0.
template <typename T>
Grid<T> in_whole_blocks(const Grid<T>& grid) {
  Grid<T> blocks(whole_blocks(grid.width), whole_blocks(grid.height));
  for (int y = 0; y < grid.height; ++y) std::copy_n(grid.row(y), grid.width, blocks.row(y));
  return blocks;
}

/// Texels in a row of make_reference_texels.
int reference_texels_stride(int width, int window);

/// A reference view with a border that the windows of all blocks fit in, black outside of the image:
/// texel i of row j holds the pixels (4 i - radius) to (4 i + 3 - radius) of row j - radius.
std::vector<Texel> make_reference_texels(const PaddedImage& image, int window);

/// Bytes of make_quads.
std::uint64_t quads_size(const PaddedImage& image);

/// For each pixel the four that a sample between it and its right and lower neighbors needs, row by row.
std::vector<Texel> make_quads(const PaddedImage& image);

}  // namespace quorum
