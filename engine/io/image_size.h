// The size of an image file without decoding it.
#pragma once

#include <filesystem>

#include "engine/core/error.h"

namespace quorum {

struct ImageSize {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  bool operator==(const ImageSize&) const = default;
};

/// Size of the stored pixels; an orientation in the file is ignored, as read_image does. JPEG (ITU T.81) and PNG (W3C)
/// files tell it in their headers, others are decoded. Fails (kInput) if the file is absent or tells no size.
Expected<ImageSize> read_image_size(const std::filesystem::path& path);

}  // namespace quorum
