#include "engine/image/padded_image.h"

#include <algorithm>

#include "shaders/layout.h"

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

int extra_sample_shift(int window) { return window > kLargestFullPrecisionWindow ? 1 : 0; }

Sample sample_bilinear(const PaddedImage& image, int u, int v, int extra_shift) {
  const int x = u >> kPositionBits;
  const int y = v >> kPositionBits;
  const int fraction_x = u & (kPositionScale - 1);
  const int fraction_y = v & (kPositionScale - 1);
  const Rgba p00 = image.at(x, y);
  const Rgba p10 = image.at(x + 1, y);
  const Rgba p01 = image.at(x, y + 1);
  const Rgba p11 = image.at(x + 1, y + 1);
  const int shift = kSampleShift + extra_shift;
  const int center = (1 << (23 - shift));
  const auto interpolate = [&](auto channel) {
    const int top =
        static_cast<int>(channel(p00)) * (kPositionScale - fraction_x) + static_cast<int>(channel(p10)) * fraction_x;
    const int bottom =
        static_cast<int>(channel(p01)) * (kPositionScale - fraction_x) + static_cast<int>(channel(p11)) * fraction_x;
    return ((top * (kPositionScale - fraction_y) + bottom * fraction_y) >> shift) - center;
  };
  return {interpolate(red_of), interpolate(green_of), interpolate(blue_of)};
}

}  // namespace quorum
