#include "engine/report/data_url.h"

#include <cstdint>

#include "engine/io/contact_sheet.h"
#include "engine/io/write_image.h"

namespace quorum {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

Expected<std::string> data_url(const ColorImage& image, int width) {
  constexpr int kQuality = 80;  // of JPEG
  QUORUM_ASSIGN(const auto bytes, encode_jpeg(image.width > width ? scale_to_width(image, width) : image, kQuality));
  return "data:image/jpeg;base64," + base64(bytes);
}

}  // namespace quorum
