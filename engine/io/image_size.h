// What the header of an image file tells, without decoding its pixels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/core/error.h"

namespace quorum {

struct ImageSize {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  bool operator==(const ImageSize&) const = default;
};

struct ImageHeader {
  ImageSize size;
  int bits = 8;            ///< of a channel
  bool has_alpha = false;  ///< a channel that says which pixels are there
};

/// The header of an image file; an orientation in it is ignored, as read_image does. PNG (W3C), JPEG (ITU T.81), TIFF
/// 6.0, WebP, BMP, PNM, HEIC and AVIF tell it, others are decoded for it. Fails (kInput) if the file is absent or tells
/// no size.
Expected<ImageHeader> read_image_header(const std::filesystem::path& path);

/// Its size alone.
Expected<ImageSize> read_image_size(const std::filesystem::path& path);

/// What reading a picture of this header into memory takes at most beside the file's bytes, in bytes: the decoder's
/// pixels and the colors that are made of them.
std::uint64_t decoded_bytes(const ImageHeader& header);

/// The factor from one size to another if it is one picture at two resolutions, each side rounded; nothing if the sides
/// differ by other factors, or so little (below 2 %) that one is cropped from the other.
std::optional<double> common_factor(ImageSize from, ImageSize to);

}  // namespace quorum
