#include "engine/io/image_size.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "engine/io/file.h"
#include "engine/io/heif_file.h"
#include "engine/io/image_file.h"
#include "engine/io/unread_image.h"

namespace quorum {
namespace {

/// Numbers of an image file; after the end of the file all are 0 and failed() is true.
class HeaderReader {
 public:
  explicit HeaderReader(std::istream& file) : file_(file) {}

  /// A number of 1 to 4 bytes.
  std::uint32_t number(int bytes, bool little_endian = false) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int next = file_.get();
      const auto byte = static_cast<std::uint32_t>(next < 0 ? 0 : next);
      value = little_endian ? value | byte << (8 * i) : value << 8 | byte;
    }
    return value;
  }
  std::string text(std::size_t bytes) {
    std::string result(bytes, '\0');
    file_.read(result.data(), static_cast<std::streamsize>(bytes));
    return result;
  }
  void go_to(std::uint64_t position) { file_.seekg(static_cast<std::streamoff>(position)); }
  void skip(std::uint64_t bytes) { file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur); }
  [[nodiscard]] bool failed() const { return !file_; }

 private:
  std::istream& file_;
};

using Found = std::optional<ImageHeader>;

/// Each segment tells its length, one of the first ones the size.
Found jpeg_header(HeaderReader& file) {
  file.go_to(2);
  while (file.number(1) == 0xff) {
    std::uint32_t kind = file.number(1);
    while (kind == 0xff) kind = file.number(1);  // fill bytes
    if (kind < 0xc0 || kind == 0xd9 || kind == 0xda) return std::nullopt;
    const std::uint32_t bytes = file.number(2);
    const bool is_frame = kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (is_frame) {
      const auto bits = static_cast<int>(file.number(1));
      const auto height = static_cast<int>(file.number(2));
      const auto width = static_cast<int>(file.number(2));
      return ImageHeader{{width, height}, bits, false};
    }
    if (bytes < 2 || file.failed()) return std::nullopt;
    file.skip(bytes - 2);
  }
  return std::nullopt;
}

Found png_header(HeaderReader& file) {
  file.go_to(16);  // behind the signature, and the length and name of the first chunk
  ImageHeader header;
  header.size.width = static_cast<int>(file.number(4));
  header.size.height = static_cast<int>(file.number(4));
  const auto bits = static_cast<int>(file.number(1));
  const std::uint32_t color = file.number(1);
  constexpr std::uint32_t kPalette = 3;
  header.bits = std::max(8, bits);
  header.has_alpha = color == 4 || color == 6;
  if (color != kPalette) return header;
  file.skip(3 + 4);  // the rest of the chunk and its checksum
  for (int chunk = 0; chunk < 64 && !file.failed(); ++chunk) {
    const std::uint32_t bytes = file.number(4);
    const std::string name = file.text(4);
    if (name == "tRNS") header.has_alpha = true;
    if (name == "tRNS" || name == "IDAT") break;
    file.skip(std::uint64_t{bytes} + 4);
  }
  return header;
}

/// The first directory of a TIFF file.
Found tiff_header(HeaderReader& file, bool little) {
  enum Tag : std::uint32_t { kWidth = 256, kHeight = 257, kBits = 258, kExtraSamples = 338 };
  file.go_to(4);
  file.go_to(file.number(4, little));
  ImageHeader header;
  const std::uint32_t entries = file.number(2, little);
  for (std::uint32_t entry = 0; entry < entries && !file.failed(); ++entry) {
    const std::uint32_t tag = file.number(2, little);
    const std::uint32_t type = file.number(2, little);
    const std::uint32_t count = file.number(4, little);
    const std::string raw = file.text(4);
    const auto byte = [&](int at) {
      return std::uint32_t{static_cast<unsigned char>(raw[static_cast<std::size_t>(at)])};
    };
    constexpr std::uint32_t kShort = 3;
    const std::uint32_t number = type == kShort ? (little ? byte(0) | byte(1) << 8 : byte(0) << 8 | byte(1))
                                 : little       ? byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24
                                                : byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
    if (tag == kWidth) header.size.width = static_cast<int>(number);
    if (tag == kHeight) header.size.height = static_cast<int>(number);
    if (tag == kExtraSamples) header.has_alpha = true;
    if (tag == kBits && count <= 2) header.bits = std::clamp(static_cast<int>(number), 8, 64);
    if (tag == kBits && count > 2) header.bits = 16;  // written elsewhere; 8 or 16
  }
  return file.failed() ? std::nullopt : Found(header);
}

Found webp_header(HeaderReader& file) {
  file.go_to(12);
  const std::string kind = file.text(4);
  ImageHeader header;
  if (kind == "VP8X") {
    file.go_to(20);
    header.has_alpha = (file.number(1) & 0x10U) != 0;
    file.go_to(24);
    header.size.width = static_cast<int>(file.number(3, true)) + 1;
    header.size.height = static_cast<int>(file.number(3, true)) + 1;
  } else if (kind == "VP8L") {
    file.go_to(21);
    const std::uint32_t bits = file.number(4, true);
    header.size = {static_cast<int>(bits & 0x3fffU) + 1, static_cast<int>(bits >> 14 & 0x3fffU) + 1};
    header.has_alpha = (bits >> 28 & 1U) != 0;
  } else if (kind == "VP8 ") {
    file.go_to(26);
    header.size.width = static_cast<int>(file.number(2, true) & 0x3fffU);
    header.size.height = static_cast<int>(file.number(2, true) & 0x3fffU);
  }
  return header;
}

Found bmp_header(HeaderReader& file) {
  file.go_to(18);
  ImageHeader header;
  header.size.width = static_cast<int>(file.number(4, true));
  const auto height = static_cast<std::int32_t>(file.number(4, true));  // negative: the top row first
  header.size.height = std::max(height, -std::max(height, -INT_MAX));
  return header;
}

/// P1 to P6: words with # comments between.
Found pnm_header(std::istream& file, char kind) {
  const auto number = [&file] {
    std::string word;
    while (file >> word && word.starts_with('#')) file.ignore(1 << 16, '\n');
    return word.size() < 10 && !word.empty() && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; })
               ? std::stoi(word)
               : 0;
  };
  file.seekg(2);
  ImageHeader header;
  header.size.width = number();
  header.size.height = number();
  const bool has_maximum = kind != '1' && kind != '4';
  if (has_maximum && number() > 255) header.bits = 16;
  return header;
}

Found header_in(std::ifstream& file) {
  HeaderReader reader(file);
  const std::string magic = reader.text(12);
  file.clear();
  if (magic.starts_with("\xff\xd8")) return jpeg_header(reader);
  if (magic.starts_with("\x89P")) return png_header(reader);
  if (magic.starts_with(std::string_view("II*\0", 4))) return tiff_header(reader, true);
  if (magic.starts_with(std::string_view("MM\0*", 4))) return tiff_header(reader, false);
  if (magic.starts_with("RIFF") && magic.ends_with("WEBP")) return webp_header(reader);
  if (magic.starts_with("BM")) return bmp_header(reader);
  if (magic[0] == 'P' && magic[1] >= '1' && magic[1] <= '6') return pnm_header(file, magic[1]);
  return std::nullopt;
}

}  // namespace

Expected<ImageHeader> read_image_header(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    std::ifstream file(path, std::ios::binary);
    std::string begin(32, '\0');
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    begin.resize(static_cast<std::size_t>(file.gcount()));
    if (const std::string why = why_unread(path, begin, false); !why.empty())
      return failure(ErrorKind::kInput, path.string() + ": " + why);
    file.clear();
    file.seekg(0);
    const auto header = header_in(file);
    if (header && !file.fail() && header->size.width > 0 && header->size.height > 0) return *header;
    file.clear();
    file.seekg(0);
    if (std::string magic(12, '\0'); file.read(magic.data(), 12) && is_heif(magic)) {
      QUORUM_ASSIGN(const auto bytes, read_file(path));
      const auto of_heif = read_heif_header(bytes);
      if (!of_heif) return std::unexpected(of_heif.error().within(path.string()));
      return *of_heif;
    }
  }
  QUORUM_ASSIGN(const auto image, read_image(path));
  return ImageHeader{{image.width, image.height}};
}

Expected<ImageSize> read_image_size(const std::filesystem::path& path) {
  QUORUM_ASSIGN(const auto header, read_image_header(path));
  return header.size;
}

std::uint64_t decoded_bytes(const ImageHeader& header) {
  const std::uint64_t channel_bytes = header.bits > 16 ? 4 : header.bits > 8 ? 2 : 1;
  constexpr std::uint64_t kColor = 4;
  return static_cast<std::uint64_t>(header.size.width) * static_cast<std::uint64_t>(header.size.height) *
         (4 * channel_bytes + kColor);
}

std::optional<double> common_factor(ImageSize from, ImageSize to) {
  constexpr double kCropped = 0.02;
  if (from.width <= 0 || from.height <= 0 || to.width <= 0 || to.height <= 0) return std::nullopt;
  if (from == to) return 1.0;
  const double factor = (static_cast<double>(to.width) + to.height) / (static_cast<double>(from.width) + from.height);
  // The smaller picture's sides were rounded, up or down.
  const double scale = std::max(1.0, factor);
  const double width_off = std::abs(from.width * factor - to.width) / scale;
  const double height_off = std::abs(from.height * factor - to.height) / scale;
  if (width_off > 1.0 || height_off > 1.0 || std::abs(factor - 1.0) < kCropped) return std::nullopt;
  return factor;
}

}  // namespace quorum
