// Image files and masks in, through OpenCV, which appears in engine/io alone.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

/// Reads an image file of any kind that OpenCV decodes, or HEIC or AVIF, as 8-bit color (gray becomes color). Of 16
/// bits the upper 8 stay of those that the file uses, that is 8, 10, 12, 14 or 16 by its largest value; where that
/// would leave less than 64 levels, and for floating-point values, the range of the file's values becomes 0 to 255. The
/// pixels stay as they are stored: an orientation in the file is ignored, because the camera belongs to the stored
/// pixels. Fails (kInput) if the file is absent or does not decode; the message names the file.
Expected<ColorImage> read_image(const std::filesystem::path& path);

/// The same from the bytes of such a file. path: what messages name.
Expected<ColorImage> decode_image(const std::filesystem::path& path, std::string bytes);

/// Says in a line how read_image takes a file of more than 8 bits, if it is not by all 16 of them; else empty. Fails as
/// read_image does.
Expected<std::string> describe_pixel_range(const std::filesystem::path& path);

/// Reads the alpha channel of a photograph as a mask: 1 where it is more than half opaque; 1 everywhere without one.
/// Fails as read_image does.
Expected<Mask> read_alpha(const std::filesystem::path& path);

/// A mask at another size, > 0, in pixels: each pixel is the nearest one.
Mask scale_mask(const Mask& mask, int width, int height);

/// Reads a mask file: 1 where the gray value is above 0, 0 elsewhere. Fails as read_image does.
Expected<Mask> read_mask(const std::filesystem::path& path);

/// Background mask of a photograph before a dark background, by the recipe of the Middlebury dino README: pixels whose
/// brightest channel exceeds level (0..1, of 255) are object; the object is dilated with the disc of radius 10 (pixels
/// whose centers are at most that far), which fills dark spots on it, then eroded with the disc of radius 7, so that it
/// keeps a margin of 3 pixels. Beyond the border there is background for the dilation and object for the erosion: what
/// the border cuts is neither grown nor eaten from there. Empty for an empty image.
Mask mask_dark_background(const ColorImage& image, double level);

}  // namespace quorum
