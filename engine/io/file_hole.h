// Zeros in a file of a picture where other bytes were, as copies and downloads leave them that broke off: the file has
// its full length, and decoders take the zeros for codes.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace quorum {

/// Where the first hole begins, bytes. A hole is all zeros between two multiples of 4096, with others before and behind
/// them, or from a multiple of 65,536 to the end: black pixels hardly ever keep to these. Of WebP and JPEG 2000, whose
/// codes never end so, also 64 zeros at the end of the codes. bytes: of the whole file.
std::optional<std::size_t> find_hole(std::string_view bytes);

}  // namespace quorum
