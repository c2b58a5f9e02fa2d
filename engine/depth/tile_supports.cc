#include "engine/depth/tile_supports.h"

#include <algorithm>

namespace quorum {
namespace {

/// A sample in 16 bits a channel, and ones above; 0 if it does not belong.
[[gnu::always_inline]] inline std::uint64_t pack_sample(Rgba pixel, bool belongs, int shift) {
  const Sample sample = sample_pixel(pixel, shift);
  const auto word = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint16_t>(value)}; };
  const std::uint64_t packed =
      word(sample.red) | word(sample.green) << 16 | word(sample.blue) << 32 | std::uint64_t{0xffff} << 48;
  return packed & -static_cast<std::uint64_t>(belongs);
}

/// Packs one place of the windows of a row.
[[gnu::always_inline]] inline void pack_row(const Rgba* pixel, const Rgba* center, const std::int32_t* most, int count,
                                            int shift, std::uint64_t* samples) {
  for (int x = 0; x < count; ++x)
    samples[x] = pack_sample(pixel[x], largest_difference(pixel[x], center[x]) <= most[x], shift);
}

}  // namespace

void TileSupports::pack(const SweepTask& task, const Grid<SupportWindow>& windows, const Tile& tile, SimdLevel simd) {
  const PaddedImage& image = *task.reference;
  const int window = task.options.window;
  const int radius = window / 2;
  const int shift = kSampleShift + extra_sample_shift(window);
  const auto pack = simd_form<pack_row>(simd);
  // A line of the cache more, so that the places of a pixel do not crowd into one set of the cache.
  constexpr std::size_t kLine = 8;
  tile_ = tile;
  stride_ = static_cast<std::size_t>(tile.x_end - tile.x) * static_cast<std::size_t>(tile.y_end - tile.y) + kLine;
  samples_.resize(stride_ * static_cast<std::size_t>(window * window));
  // Windows that stick out of the image are never tried.
  const int x = std::max(tile.x, radius);
  const int count = std::min(tile.x_end, image.width - radius) - x;
  most_.resize(static_cast<std::size_t>(std::max(count, 0)));
  for (int y = std::max(tile.y, radius); y < std::min(tile.y_end, image.height - radius); ++y) {
    std::transform(windows.row(y) + x, windows.row(y) + x + most_.size(), most_.begin(),
                   [](const SupportWindow& support) { return support.max_difference; });
    const Rgba* center = image.pixels.data() + std::ptrdiff_t{y} * image.stride() + x;
    for (int index = 0; index < window * window; ++index) {
      const Rgba* pixel = center + std::ptrdiff_t{index / window - radius} * image.stride() + index % window - radius;
      std::uint64_t* samples = samples_.data() + static_cast<std::size_t>(index) * stride_ + this->pixel(x, y);
      pack(pixel, center, most_.data(), count, shift, samples);
    }
  }
}

}  // namespace quorum
