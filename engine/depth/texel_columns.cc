#include "engine/depth/texel_columns.h"

#include <oneapi/tbb/parallel_for.h>

#include <bit>

namespace quorum {
namespace {

/// Bytes red, green, blue to the bytes 0, 2 and 4 of an entry.
std::uint64_t spread_channels(Rgba texel) {
  return std::uint64_t{red_of(texel)} | std::uint64_t{green_of(texel)} << 16 | std::uint64_t{blue_of(texel)} << 32;
}

}  // namespace

TexelColumns make_texel_columns(const PaddedImage& image) {
  static_assert(std::endian::native == std::endian::little, "an entry is read byte by byte");
  constexpr std::uint64_t kSigns = 0x0000'8080'8080'8080U;
  const auto stride = static_cast<std::size_t>(image.stride());
  TexelColumns columns{image.stride(), image.width, image.height, {}};
  columns.entries.resize(stride * static_cast<std::size_t>(image.height));
  tbb::parallel_for(0, image.height, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * stride;
    for (std::size_t i = first; i < first + stride; ++i)
      columns.entries[i] = (spread_channels(image.pixels[i + stride]) | spread_channels(image.pixels[i]) << 8) ^ kSigns;
  });
  return columns;
}

}  // namespace quorum
