// A photograph as the CPU's kernels read it: what interpolation needs of four texels lies side by side, so that one
// load of 16 bytes has it, and bytes are signed, as the multiplications of 8 and 16 bits want them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/image/padded_image.h"

namespace quorum {

/// An entry for each texel that has one below, in rows of stride: red of the one below, red, green of the one below,
/// green, blue likewise, each less 128, and two bytes of 0. Entries of texels beside each other lie beside each other.
struct TexelColumns {
  int stride = 0;
  int width = 0;   ///< of the image, pixels
  int height = 0;  ///< of the image, pixels
  std::vector<std::uint64_t> entries;
};

/// Takes 8 bytes a pixel. Cannot fail.
TexelColumns make_texel_columns(const PaddedImage& image);

}  // namespace quorum
