// What is missing or damaged in a JPEG file. Decoders fill it with gray or with noise and say so in warnings alone,
// which OpenCV drops; libjpeg is asked directly.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

struct JpegFlaw {
  enum class Kind {
    kNone,
    kNoEnd,    ///< the picture is whole, and the marker of the end is missing behind it
    kCut,      ///< the file ends before the picture does
    kDamaged,  ///< codes that are none, too few or too many of them in a segment
  };
  Kind kind = Kind::kNone;
  int row = 0;     ///< of the picture, about where it begins; 0 = not known
  int height = 0;  ///< of the picture, rows
};

/// Reads the codes of all pixels, at an eighth of the size (about half of what decoding takes). Sound are also
/// zeros before a marker, which some cameras write, and whatever stands behind the end. Damage that leaves as
/// many codes as there were is not seen. None for what is no JPEG file, or what libjpeg gives up: decoders fail there.
/// bytes: of the whole file. Source: ITU T.81; libjpeg-turbo, jerror.h.
JpegFlaw find_jpeg_flaw(std::string_view bytes);

/// True for a JPEG file that has no marker of the end, and is whole without it. Reads the end of the file alone where
/// the marker stands there. Fails (kInput) if the file can't be read, or is cut or damaged.
Expected<bool> is_jpeg_without_end(const std::filesystem::path& path);

}  // namespace quorum
