#include "engine/image/padded_image.h"

#include <algorithm>

namespace quorum {

PaddedImage pad_image(const ColorImage& image) {
  PaddedImage padded{image.width, image.height, {}};
  padded.pixels.reserve((image.values.size() + static_cast<std::size_t>(image.width + image.height + 1)));
  for (int y = 0; y <= image.height; ++y) {
    const Rgba* row = image.row(std::min(y, image.height - 1));
    padded.pixels.insert(padded.pixels.end(), row, row + image.width);
    padded.pixels.push_back(row[image.width - 1]);
  }
  return padded;
}

Sample sample_bilinear(const PaddedImage& image, int u, int v, int extra_shift) {
  const Rgba* texel = image.pixels.data() + texel_index(u, v, image.stride());
  return sample_bilinear(texel[0], texel[1], texel[image.stride()], texel[image.stride() + 1], u, v,
                         kSampleShift + extra_shift);
}

}  // namespace quorum
