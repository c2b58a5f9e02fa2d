// What is missing or damaged in a TIFF file. OpenCV asks libtiff for the pixels, and goes on with black where it fails;
// libtiff is asked directly.
#pragma once

#include <optional>
#include <string_view>

namespace quorum {

struct TiffFlaw {
  int row = 0;     ///< of the picture, where the first strip or tile begins that is not whole
  int height = 0;  ///< of the picture, rows
};

/// Decodes all strips or tiles of the first picture (about as long as decoding takes); nothing if they are whole.
/// Damage is seen where a strip ends beyond the file or has codes that are none, and with Deflate by its checksum;
/// without compression a wrong byte is a color like any other. Nothing also for what is no TIFF file, has no first
/// picture, or is compressed in a way that libtiff was built without: decoders fail there. bytes: of the whole file.
/// Source: Adobe, TIFF 6.0; libtiff 4.5.
std::optional<TiffFlaw> find_tiff_flaw(std::string_view bytes);

}  // namespace quorum
