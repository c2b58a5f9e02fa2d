#include "engine/io/unread_image.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/io/view_names.h"

namespace quorum {
namespace {

constexpr std::array<std::string_view, 14> kRawEndings = {".dng", ".nef", ".nrw", ".cr2", ".cr3", ".arw", ".orf",
                                                          ".rw2", ".raf", ".pef", ".srw", ".iiq", ".3fr", ".raw"};

/// How a file begins that is no picture for us, and what helps.
struct Beginning {
  std::string_view bytes;
  std::string_view remedy;
};
constexpr Beginning kBeginnings[] = {
    {"GIF8", "is a GIF picture; convert it to PNG"},
    {"8BPS", "is a Photoshop file; save it as TIFF or PNG"},
    {"\xff\x0a", "is a JPEG XL picture; convert it to PNG (djxl)"},
    {std::string_view("\0\0\0\x0cJXL ", 8), "is a JPEG XL picture; convert it to PNG (djxl)"},
    {"%PDF", "is a PDF file; give the photograph itself"},
    {"version https://git-lfs", "is a pointer of Git LFS in place of the photograph; get it with git lfs pull"}};

std::uint32_t byte_at(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

/// True if the data behind the first scan's header never comes to the marker of the end; in it 0xff has 0 behind it.
bool lacks_end(std::string_view jpeg) {
  constexpr std::uint32_t kScan = 0xda;
  for (std::size_t at = 2; at + 4 <= jpeg.size() && byte_at(jpeg, at) == 0xff;) {
    const std::uint32_t kind = byte_at(jpeg, at + 1);
    if (kind == 0xff) {
      ++at;
      continue;
    }
    if (kind == kScan) return jpeg.find("\xff\xd9", at) == std::string_view::npos;
    at += 2 + (byte_at(jpeg, at + 2) << 8 | byte_at(jpeg, at + 3));
  }
  return false;  // damage that decoders tell
}

}  // namespace

std::string why_unread(const std::filesystem::path& path, std::string_view bytes, bool is_whole) {
  for (const Beginning& beginning : kBeginnings)
    if (bytes.starts_with(beginning.bytes)) return std::string(beginning.remedy);
  const bool is_jpeg = bytes.starts_with("\xff\xd8");
  if (!is_jpeg && !bytes.starts_with("\x89PNG") &&
      std::ranges::count(kRawEndings, folded(path.extension().string())) > 0)
    return "is a raw photograph; develop all of them to TIFF, PNG or JPEG of the same size (darktable-cli, "
           "rawtherapee-cli)";
  if (is_whole && is_jpeg && lacks_end(bytes))
    return "ends too early, and its lower part would be gray; copy it again, or save it anew if it looks whole";
  return {};
}

}  // namespace quorum
