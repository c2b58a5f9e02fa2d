// The stored pixels of an image file as OpenCV holds them, of every kind of file that is read.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "engine/core/error.h"

namespace quorum {

/// Decodes the stored pixels with the flags of cv::imdecode; an orientation in the file is ignored. path: for messages.
/// Fails (kInput) if the bytes are no image, are damaged or of a kind that is not read, and (kMemory) if they don't
/// fit.
Expected<cv::Mat> decode_pixels(const std::filesystem::path& path, std::string bytes, int flags);

}  // namespace quorum
