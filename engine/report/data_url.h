// Bytes and pictures as text that stands in a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/image.h"

namespace quorum {

/// Text in base64 (RFC 4648), padded.
std::string base64(std::string_view bytes);

/// The values as they lie in memory, in base64.
template <typename T>
std::string base64_of(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

/// A picture as the address of a JPEG file, at most `width` pixels wide. Fails (kInput) if it can't be encoded.
Expected<std::string> data_url(const ColorImage& image, int width);

}  // namespace quorum
