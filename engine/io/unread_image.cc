#include "engine/io/unread_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/io/file_hole.h"
#include "engine/io/heif_file.h"
#include "engine/io/jpeg_flaw.h"
#include "engine/io/tiff_flaw.h"
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

/// How files begin that are decoded. Whatever else OpenCV may know it hands to libraries for other fields (DICOM,
/// maps), of which some end the process over a damaged file.
constexpr std::string_view kDecoded[] = {"\xff\xd8",
                                         "\x89PNG\r\n\x1a\n",
                                         std::string_view("II*\0", 4),
                                         std::string_view("MM\0*", 4),
                                         std::string_view("II+\0", 4),
                                         std::string_view("MM\0+", 4),
                                         "RIFF",
                                         "BM",
                                         "P1",
                                         "P2",
                                         "P3",
                                         "P4",
                                         "P5",
                                         "P6",
                                         "P7",
                                         std::string_view("\0\0\0\x0cjP  ", 8),
                                         "\xff\x4f\xff\x51"};

bool is_decoded(std::string_view bytes) {
  if (bytes.starts_with("RIFF") && (bytes.size() < 12 || bytes.substr(8, 4) != "WEBP")) return false;
  return std::ranges::any_of(kDecoded, [bytes](std::string_view begin) { return bytes.starts_with(begin); });
}

constexpr std::string_view kRemedy = "copy it again, or save it anew if it looks whole";

std::string damaged_from(int row, int height) {
  if (row == 0) return fmt::format("is damaged within the picture; {}", kRemedy);
  return fmt::format("is damaged within the picture, from about row {} of {} on; {}", row, height, kRemedy);
}

/// Of a JPEG file; empty if it is whole, maybe but for the marker behind it.
std::string why_not_whole(std::string_view jpeg) {
  const JpegFlaw flaw = find_jpeg_flaw(jpeg);
  if (flaw.kind == JpegFlaw::Kind::kCut)
    return fmt::format("ends too early, and its lower part would be gray; {}", kRemedy);
  return flaw.kind == JpegFlaw::Kind::kDamaged ? damaged_from(flaw.row, flaw.height) : std::string();
}

/// Of the other kinds, whose decoders tell of less.
std::string why_with_holes(std::string_view bytes) {
  if (const auto begin = find_hole(bytes))
    return fmt::format(
        "holds zeros in place of the picture from byte {} on; copy it again, or save it as PNG if it "
        "looks whole",
        *begin);
  const auto flaw = find_tiff_flaw(bytes);
  return flaw ? damaged_from(flaw->row, flaw->height) : std::string();
}

}  // namespace

std::string why_unread(const std::filesystem::path& path, std::string_view bytes, bool is_whole) {
  for (const Beginning& beginning : kBeginnings)
    if (bytes.starts_with(beginning.bytes)) return std::string(beginning.remedy);
  const bool is_jpeg = bytes.starts_with("\xff\xd8");
  const bool is_png = bytes.starts_with("\x89PNG");
  if (!is_jpeg && !is_png && std::ranges::count(kRawEndings, folded(path.extension().string())) > 0)
    return "is a raw photograph; develop all of them to TIFF, PNG or JPEG of the same size (darktable-cli, "
           "rawtherapee-cli)";
  if (!is_whole || is_heif(bytes)) return {};
  if (!is_decoded(bytes)) return "is damaged or of an unknown kind of image; replace the file";
  if (is_png) return {};  // PNG has checksums, which its decoder asks
  return is_jpeg ? why_not_whole(bytes) : why_with_holes(bytes);
}

}  // namespace quorum
