// Pictures side by side with a line of text below each.
#pragma once

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

struct Panel {
  ColorImage image;
  std::string caption;  ///< ASCII; what is wider than the column is cut
};

/// The panels row by row, `columns` (>= 1) to a row, on white; pictures smaller than the largest stand in the middle of
/// their places. Empty without panels. Cannot fail.
ColorImage contact_sheet(const std::vector<Panel>& panels, int columns);

/// The part of an image from (x, y) on, width × height pixels, cut to the image.
ColorImage crop(const ColorImage& image, int x, int y, int width, int height);

/// The image turned to the left by quarters of a full turn, 0 to 3.
ColorImage turn_left(const ColorImage& image, int quarters);

/// The image scaled to a width, > 0, in pixels; the height follows. Pixels are means of what they cover.
ColorImage scale_to_width(const ColorImage& image, int width);

}  // namespace quorum
