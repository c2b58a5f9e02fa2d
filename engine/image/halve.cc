#include "engine/image/halve.h"

namespace quorum {
namespace {

template <typename T, typename Merge>
Grid<T> halve(const Grid<T>& grid, const Merge& merge) {
  Grid<T> half(grid.width / 2, grid.height / 2);
  for (int y = 0; y < half.height; ++y) {
    const T* upper = grid.row(2 * y);
    const T* lower = grid.row(2 * y + 1);
    for (int x = 0; x < half.width; ++x)
      half.at(x, y) = merge(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
  }
  return half;
}

}  // namespace

ColorImage halve_image(const ColorImage& image) {
  return halve(image, [](Rgba a, Rgba b, Rgba c, Rgba d) {
    const auto mean = [&](auto channel) { return (channel(a) + channel(b) + channel(c) + channel(d) + 2) / 4; };
    return make_rgb(mean(red_of), mean(green_of), mean(blue_of));
  });
}

Mask halve_mask(const Mask& mask) {
  return halve(mask, [](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    return static_cast<std::uint8_t>(a & b & c & d);
  });
}

}  // namespace quorum
