#include "engine/render/compare_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/core/check.h"

namespace quorum {
namespace {

double brightness(Rgba pixel) { return 0.299 * red_of(pixel) + 0.587 * green_of(pixel) + 0.114 * blue_of(pixel); }

/// Of the window around a pixel; nothing where it is not compared as a whole.
std::optional<double> window_likeness(const ColorImage& a, const ColorImage& b, const Mask& where, int x, int y) {
  constexpr int kReach = 3;
  constexpr double kCount = (2 * kReach + 1) * (2 * kReach + 1);
  constexpr double kSmallMean = 0.01 * 255 * 0.01 * 255;
  constexpr double kSmallSpread = 0.03 * 255 * 0.03 * 255;
  double sum_a = 0;
  double sum_b = 0;
  double sum_aa = 0;
  double sum_bb = 0;
  double sum_ab = 0;
  for (int row = y - kReach; row <= y + kReach; ++row)
    for (int column = x - kReach; column <= x + kReach; ++column) {
      if (!where.contains(column, row) || where.at(column, row) == 0) return std::nullopt;
      const double value_a = brightness(a.at(column, row));
      const double value_b = brightness(b.at(column, row));
      sum_a += value_a;
      sum_b += value_b;
      sum_aa += value_a * value_a;
      sum_bb += value_b * value_b;
      sum_ab += value_a * value_b;
    }
  const double mean_a = sum_a / kCount;
  const double mean_b = sum_b / kCount;
  const double spread = sum_aa / kCount - mean_a * mean_a + sum_bb / kCount - mean_b * mean_b;
  const double together = sum_ab / kCount - mean_a * mean_b;
  return (2 * mean_a * mean_b + kSmallMean) * (2 * together + kSmallSpread) /
         ((mean_a * mean_a + mean_b * mean_b + kSmallMean) * (spread + kSmallSpread));
}

}  // namespace

PictureLikeness compare_pictures(const ColorImage& a, const ColorImage& b, const Mask& where) {
  QUORUM_CHECK_EQ(a.values.size(), b.values.size());
  QUORUM_CHECK_EQ(a.values.size(), where.values.size());
  PictureLikeness likeness;
  double squares = 0;
  double ssim = 0;
  double windows = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (where.at(x, y) == 0) continue;
      ++likeness.pixels;
      for (const auto channel : {red_of, green_of, blue_of}) {
        const double difference = static_cast<double>(channel(a.at(x, y))) - static_cast<double>(channel(b.at(x, y)));
        squares += difference * difference;
      }
      if (const auto like = window_likeness(a, b, where, x, y)) {
        ssim += *like;
        ++windows;
      }
    }
  constexpr double kEqual = 99;
  if (likeness.pixels > 0)
    likeness.psnr =
        squares > 0
            ? std::min(kEqual, 10 * std::log10(255.0 * 255.0 * 3 * static_cast<double>(likeness.pixels) / squares))
            : kEqual;
  likeness.ssim = windows > 0 ? ssim / windows : 0;
  return likeness;
}

}  // namespace quorum
