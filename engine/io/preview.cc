#include "engine/io/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace quorum {
namespace {

using Palette = std::array<Rgba, 256>;

Palette make_turbo() {
  cv::Mat levels(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::Mat colors;
  cv::applyColorMap(levels, colors, cv::COLORMAP_TURBO);
  Palette palette;
  for (int i = 0; i < 256; ++i) {
    const auto& blue_green_red = colors.at<cv::Vec3b>(i);
    palette[i] = make_rgb(blue_green_red[2], blue_green_red[1], blue_green_red[0]);
  }
  return palette;
}

bool is_depth(float value) { return std::isfinite(value) && value > 0.0F; }

/// 0 to 255 for 0 to 1, clamped; 0 for what is not a number.
std::uint32_t level_of(float value) {
  return value > 0.0F ? static_cast<std::uint32_t>(std::min(value, 1.0F) * 255.0F + 0.5F) : 0U;
}

}  // namespace

ColorImage color_map_depth(const Grid<float>& depth) {
  ColorImage image(depth.width, depth.height, make_rgb(0, 0, 0));
  std::vector<float> depths;
  std::ranges::copy_if(depth.values, std::back_inserter(depths), is_depth);
  if (depths.empty()) return image;
  std::ranges::sort(depths);
  const float nearest = depths[(depths.size() - 1) / 100];
  const float farthest = depths[depths.size() - 1 - (depths.size() - 1) / 100];
  const float range = farthest > nearest ? farthest - nearest : 1.0F;

  static const Palette kTurbo = make_turbo();
  std::ranges::transform(depth.values, image.values.begin(), [nearest, range](float value) {
    return is_depth(value) ? kTurbo[level_of((value - nearest) / range)] : make_rgb(0, 0, 0);
  });
  return image;
}

ColorImage color_map_unit(const Grid<float>& map) {
  ColorImage image(map.width, map.height);
  std::ranges::transform(map.values, image.values.begin(), [](float value) {
    const std::uint32_t level = level_of(value);
    return make_rgb(level, level, level);
  });
  return image;
}

ColorImage color_map_normal(const Grid<Eigen::Vector3f>& normals) {
  ColorImage image(normals.width, normals.height);
  const auto level = [](float value) {
    return static_cast<std::uint32_t>(std::clamp(value, -1.0F, 1.0F) * 127.5F + 127.5F);
  };
  for (std::size_t i = 0; i < normals.values.size(); ++i) {
    const Eigen::Vector3f& normal = normals.values[i];
    const bool exists = normal.x() != 0.0F || normal.y() != 0.0F || normal.z() != 0.0F;
    image.values[i] = exists ? make_rgb(level(normal.x()), level(-normal.y()), level(-normal.z())) : make_rgb(0, 0, 0);
  }
  return image;
}

}  // namespace quorum
