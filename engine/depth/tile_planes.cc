#include "engine/depth/tile_planes.h"

#include <algorithm>
#include <bit>

#include "engine/core/check.h"

namespace quorum {
namespace {

/// Pixels of a tile: a word per row, a bit per pixel.
class PixelSet {
 public:
  explicit PixelSet(const std::uint64_t* rows) : rows_(rows) {}

  /// The smallest rectangle that holds all pixels of the set within the given one; without area if there are none.
  [[nodiscard]] Tile bounds(const Tile& within) const {
    const std::uint64_t columns = columns_below(within.x_end) & ~columns_below(within.x);
    std::uint64_t any = 0;
    int first = within.y_end;
    int last = within.y_end;
    for (int y = within.y; y < within.y_end; ++y) {
      const std::uint64_t row = rows_[y] & columns;
      if (row == 0) continue;
      if (any == 0) first = y;
      last = y;
      any |= row;
    }
    if (any == 0) return {within.x, within.y, within.x, within.y};
    return {std::countr_zero(any), first, kMaxTileSide - std::countl_zero(any), last + 1};
  }

 private:
  /// Columns 0 to x - 1. x: 0 to 64.
  static std::uint64_t columns_below(int x) { return x < kMaxTileSide ? (1ULL << x) - 1 : ~0ULL; }

  const std::uint64_t* rows_;
};

/// What it takes to sweep a rectangle, in samples: rows come in whole vectors, and each has its own overhead.
int cost(const Tile& part, int border) {
  constexpr int kVector = 8;
  constexpr int kRowOverhead = 8;
  if (part.x == part.x_end) return 0;
  const int samples = (part.x_end - part.x + border + kVector - 1) / kVector * kVector;
  return (samples + kRowOverhead) * (part.y_end - part.y + border);
}

/// Covers the pixels within part, which is their bounds, by rectangles: cuts it in two for as long as that makes it
/// cheaper.
template <typename Emit>
void cut(const PixelSet& pixels, const Tile& part, int border, const Emit& emit) {
  constexpr int kColumnStep = 4;
  int least = cost(part, border);
  Tile best_first;
  Tile best_second;
  const auto consider = [&](const Tile& first, const Tile& second) {
    const int both = cost(first, border) + cost(second, border);
    if (both >= least) return;
    least = both;
    best_first = first;
    best_second = second;
  };
  for (int y = part.y + 1; y < part.y_end; ++y)
    consider(pixels.bounds({part.x, part.y, part.x_end, y}), pixels.bounds({part.x, y, part.x_end, part.y_end}));
  for (int x = part.x + kColumnStep; x < part.x_end; x += kColumnStep)
    consider(pixels.bounds({part.x, part.y, x, part.y_end}), pixels.bounds({x, part.y, part.x_end, part.y_end}));
  if (best_first.x == best_first.x_end) {
    emit(part);
    return;
  }
  cut(pixels, best_first, border, emit);
  cut(pixels, best_second, border, emit);
}

}  // namespace

void TilePlanes::collect(const Grid<PlaneRange>& ranges, const Tile& tile, int stride, int window) {
  const int width = tile.x_end - tile.x;
  const int height = tile.y_end - tile.y;
  QUORUM_CHECK_LE(width, kMaxTileSide);
  QUORUM_CHECK_LE(height, kMaxTileSide);
  const auto for_each_range = [&](auto visit) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (const PlaneRange& range = ranges.at(tile.x + x, tile.y + y); range.first <= range.last) visit(x, y, range);
  };
  planes_.clear();
  tests_ = 0;
  const uint step = static_cast<uint>(stride);
  uint first = ~0U;
  uint last = 0;
  for_each_range([&](int, int, const PlaneRange& range) {
    first = std::min(first, range.first);
    last = std::max(last, range.last);
    tests_ += (range.last - range.first) / step + 1;
  });
  if (first > last) return;

  // Where a pixel's range begins and where it is over, its bit changes; then each plane has the bits of the one before
  // and these changes.
  const auto rows = static_cast<std::size_t>(height);
  const std::size_t plane_count = (last - first) / step + 1;
  pixels_.assign((plane_count + 1) * rows, 0);
  for_each_range([&](int x, int y, const PlaneRange& range) {
    const std::size_t begin = (range.first - first + step - 1) / step;
    const std::size_t end = (range.last - first) / step + 1;
    pixels_[begin * rows + static_cast<std::size_t>(y)] ^= 1ULL << x;
    pixels_[end * rows + static_cast<std::size_t>(y)] ^= 1ULL << x;
  });
  for (std::size_t index = rows; index < plane_count * rows; ++index) pixels_[index] ^= pixels_[index - rows];

  for (std::size_t index = 0; index < plane_count; ++index) {
    const PixelSet pixels(pixels_.data() + index * rows);
    const Tile all = pixels.bounds({0, 0, width, height});
    if (all.x == all.x_end) continue;
    cut(pixels, all, window - 1, [&](const Tile& part) {
      planes_.push_back({static_cast<int>(first + static_cast<uint>(index) * step),
                         {tile.x + part.x, tile.y + part.y, tile.x + part.x_end, tile.y + part.y_end}});
    });
  }
}

std::uint64_t TilePlanes::samples(int window) const {
  std::uint64_t total = 0;
  for (const TilePlane& plane : planes_)
    total += static_cast<std::uint64_t>(plane.part.x_end - plane.part.x + window - 1) *
             static_cast<std::uint64_t>(plane.part.y_end - plane.part.y + window - 1);
  return total;
}

}  // namespace quorum
