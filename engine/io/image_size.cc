#include "engine/io/image_size.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>

#include "engine/io/image_file.h"

namespace quorum {
namespace {

template <std::size_t kCount>
std::optional<std::array<std::uint8_t, kCount>> read_bytes(std::istream& file) {
  std::array<std::uint8_t, kCount> bytes;
  file.read(reinterpret_cast<char*>(bytes.data()), kCount);
  if (!file) return std::nullopt;
  return bytes;
}

/// The file stands behind the marker that opens a JPEG; each segment tells its length, one of the first ones the size.
std::optional<ImageSize> jpeg_size(std::istream& file) {
  while (auto marker = read_bytes<2>(file)) {
    if ((*marker)[0] != 0xff) return std::nullopt;
    int kind = (*marker)[1];
    while (kind == 0xff) kind = file.get();  // fill bytes
    if (kind < 0xc0 || kind == 0xd9 || kind == 0xda) return std::nullopt;
    const auto length = read_bytes<2>(file);
    if (!length) return std::nullopt;
    const bool is_frame = kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (is_frame) {
      const auto frame = read_bytes<5>(file);  // bits, height, width
      if (!frame) return std::nullopt;
      return ImageSize{(*frame)[3] << 8 | (*frame)[4], (*frame)[1] << 8 | (*frame)[2]};
    }
    const int bytes = ((*length)[0] << 8 | (*length)[1]) - 2;
    if (bytes < 0) return std::nullopt;
    file.seekg(bytes, std::ios::cur);
  }
  return std::nullopt;
}

std::optional<ImageSize> png_size(std::istream& file) {
  file.seekg(16);  // behind the signature, and the length and name of the first chunk
  const auto sizes = read_bytes<8>(file);
  if (!sizes) return std::nullopt;
  const auto number = [&](std::size_t at) {
    return static_cast<int>(std::uint32_t{(*sizes)[at]} << 24 | std::uint32_t{(*sizes)[at + 1]} << 16 |
                            std::uint32_t{(*sizes)[at + 2]} << 8 | std::uint32_t{(*sizes)[at + 3]});
  };
  return ImageSize{number(0), number(4)};
}

std::optional<ImageSize> size_in_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto magic = read_bytes<2>(file);
  if (!magic) return std::nullopt;
  if ((*magic)[0] == 0xff && (*magic)[1] == 0xd8) return jpeg_size(file);
  if ((*magic)[0] == 0x89 && (*magic)[1] == 'P') return png_size(file);
  return std::nullopt;
}

}  // namespace

Expected<ImageSize> read_image_size(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
    if (const auto size = size_in_header(path); size && size->width > 0 && size->height > 0) return *size;
  const auto image = read_image(path);
  if (!image) return std::unexpected(image.error());
  return ImageSize{image->width, image->height};
}

}  // namespace quorum
