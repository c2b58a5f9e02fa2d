// Image files in and out, through OpenCV, which appears in engine/io alone.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

/// Reads an image file of any kind that OpenCV decodes, as 8-bit color (gray becomes color, 16 bits are scaled). The
/// pixels stay as they are stored: an orientation in the file is ignored, because the camera belongs to the stored
/// pixels. Fails (kInput) if the file is absent or does not decode; the message names the file.
Expected<ColorImage> read_image(const std::filesystem::path& path);

/// Reads a mask file: 1 where the gray value is above 0, 0 elsewhere. Fails as read_image does.
Expected<Mask> read_mask(const std::filesystem::path& path);

/// Writes an image as PNG under path, through a temporary file, so that path never holds half an image.
/// Fails (kInput) if the image is empty or the file can't be written.
Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image);

/// Background mask of a photograph before a dark background, by the recipe of the Middlebury dino README: pixels whose
/// brightest channel exceeds level (0..1, of 255) are object; the object is dilated with the disc of radius 10 (pixels
/// whose centers are at most that far), which fills dark spots on it, then eroded with the disc of radius 7, so that it
/// keeps a margin of 3 pixels. Beyond the border there is background for the dilation and object for the erosion: what
/// the border cuts is neither grown nor eaten from there. Empty for an empty image.
Mask mask_dark_background(const ColorImage& image, double level);

}  // namespace quorum
