// Images out: as bytes, and as files that are never half there.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

/// An image as the bytes of a PNG file. Fails (kInput) if it is empty or too large for one.
Expected<std::string> encode_png(const ColorImage& image);

/// The same as JPEG, sides up to 65,535 pixels; quality: 1 to 100.
Expected<std::string> encode_jpeg(const ColorImage& image, int quality);

/// Writes an image as PNG under path, through a temporary file, so that path never holds half an image.
/// Fails (kInput) if the image is empty or the file can't be written.
Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image);

/// The same in the format that the ending of path names: .png, .jpg, .jpeg, .tif, .tiff, .bmp or .webp. Fails (kUsage)
/// if it is another one.
Expected<void> write_image(const std::filesystem::path& path, const ColorImage& image);

}  // namespace quorum
