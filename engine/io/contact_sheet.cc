#include "engine/io/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "engine/core/check.h"

namespace quorum {
namespace {

constexpr int kMargin = 6;          // pixels around each panel
constexpr int kCaptionHeight = 18;  // pixels
constexpr double kFontScale = 0.42;

/// The image's own memory as OpenCV sees it: channels red, green, blue, and one that is not used.
cv::Mat as_mat(ColorImage& image) { return {image.height, image.width, CV_8UC4, image.values.data()}; }

}  // namespace

ColorImage crop(const ColorImage& image, int x, int y, int width, int height) {
  const int left = std::clamp(x, 0, image.width);
  const int top = std::clamp(y, 0, image.height);
  ColorImage part(std::clamp(x + width, left, image.width) - left, std::clamp(y + height, top, image.height) - top);
  for (int row = 0; row < part.height; ++row)
    std::copy_n(image.row(top + row) + left, part.width,
                part.values.data() + static_cast<std::ptrdiff_t>(row) * part.width);
  return part;
}

ColorImage turn_left(const ColorImage& image, int quarters) {
  if (quarters == 0) return image;
  ColorImage turned(image.height, image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) turned.at(y, image.width - 1 - x) = image.at(x, y);
  return turn_left(turned, quarters - 1);
}

ColorImage scale_to_width(const ColorImage& image, int width) {
  QUORUM_CHECK_GE(width, 1);
  if (image.empty()) return image;
  ColorImage source = image;
  ColorImage scaled(width,
                    std::max(1, static_cast<int>(static_cast<double>(image.height) * width / image.width + 0.5)));
  cv::Mat target = as_mat(scaled);
  cv::resize(as_mat(source), target, target.size(), 0, 0, cv::INTER_AREA);
  return scaled;
}

ColorImage contact_sheet(const std::vector<Panel>& panels, int columns) {
  QUORUM_CHECK_GE(columns, 1);
  if (panels.empty()) return {};
  int width = 0;
  int height = 0;
  for (const Panel& panel : panels) {
    width = std::max(width, panel.image.width);
    height = std::max(height, panel.image.height);
  }
  const int count = static_cast<int>(panels.size());
  const int used_columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const int step_x = width + kMargin;
  const int step_y = height + kCaptionHeight + kMargin;
  ColorImage sheet(kMargin + used_columns * step_x, kMargin + rows * step_y, make_rgb(255, 255, 255));
  cv::Mat target = as_mat(sheet);
  for (int index = 0; index < count; ++index) {
    const Panel& panel = panels[static_cast<std::size_t>(index)];
    const int x = kMargin + index % columns * step_x;
    const int y = kMargin + index / columns * step_y;
    const int inner_x = x + (width - panel.image.width) / 2;
    const int inner_y = y + (height - panel.image.height) / 2;
    for (int row = 0; row < panel.image.height; ++row)
      std::copy_n(panel.image.row(row), panel.image.width, sheet.row(inner_y + row) + inner_x);
    cv::Mat line = target(cv::Rect(x, y + height, width, kCaptionHeight));
    cv::putText(line, panel.caption, {2, kCaptionHeight - 5}, cv::FONT_HERSHEY_SIMPLEX, kFontScale,
                cv::Scalar(30, 30, 30, 255), 1, cv::LINE_AA);
  }
  return sheet;
}

}  // namespace quorum
