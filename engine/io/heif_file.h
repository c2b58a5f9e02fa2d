// HEIC and AVIF photographs (ISO/IEC 23008-12), which Debian's OpenCV does not read, through libheif.
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

#include "engine/core/error.h"
#include "engine/io/image_size.h"

namespace quorum {

/// True if the first 12 bytes of a file are those of HEIC or AVIF.
bool is_heif(std::string_view bytes);

/// The size of the main picture of such a file, from all of its bytes, without decoding it. A turn that the file asks
/// for counts: it is part of the format, and all programs apply it. Fails (kInput).
Expected<ImageHeader> read_heif_header(std::string_view bytes);

/// The main picture, 8 bits a channel whatever the file has: blue, green, red, and its alpha channel if there is one.
/// Fails (kInput).
Expected<cv::Mat> decode_heif(std::string_view bytes);

}  // namespace quorum
