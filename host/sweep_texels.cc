#include "host/sweep_texels.h"

namespace quorum {

int reference_texels_stride(int width, int window) { return (whole_blocks(width) + window - 1 + 3) / 4; }

std::vector<Texel> make_reference_texels(const PaddedImage& image, int window) {
  const int radius = window / 2;
  const int stride = reference_texels_stride(image.width, window);
  const int rows = whole_blocks(image.height) + window - 1;
  std::vector<Texel> texels(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows));
  for (int y = 0; y < image.height; ++y) {
    Texel* row = texels.data() + static_cast<std::ptrdiff_t>(y + radius) * stride;
    for (int x = 0; x < image.width; ++x)
      row[(x + radius) / 4][static_cast<std::size_t>((x + radius) % 4)] = image.at(x, y);
  }
  return texels;
}

std::uint64_t quads_size(const PaddedImage& image) {
  return sizeof(Texel) * static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
}

std::vector<Texel> make_quads(const PaddedImage& image) {
  std::vector<Texel> quads(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  Texel* quad = quads.data();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      *quad++ = {image.at(x, y), image.at(x + 1, y), image.at(x, y + 1), image.at(x + 1, y + 1)};
  return quads;
}

}  // namespace quorum
